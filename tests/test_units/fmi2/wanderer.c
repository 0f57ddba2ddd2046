/* Goes to the folder of its FMU when it is made, and reads a file there by its relative name in
 * each step, as units do that were tested alone in their process. */
#include <stdio.h>
#include <unistd.h>

#include "tests/test_units/fmi2/unit.h"

enum { kSize = FIRST_OTHER };

static void unit_start(Unit* unit) {
  char folder[sizeof unit->resources];
  strcpy(folder, unit->resources + strlen("file://"));
  *strrchr(folder, '/') = '\0';
  if (chdir(folder) != 0) LOG(unit, fmi2Warning, "%s cannot be entered", folder);
}

static void unit_outputs(Unit* unit) { (void)unit; }

static fmi2Status unit_step(Unit* unit, double begin, double size) {
  FILE* const file = fopen("modelDescription.xml", "r");
  (void)begin, (void)size;
  if (file == NULL) {
    LOG(unit, fmi2Error, "modelDescription.xml is not there");
    return fmi2Error;
  }
  fseek(file, 0, SEEK_END);
  unit->model.real[kSize] = (double)ftell(file);
  fclose(file);
  return fmi2OK;
}

static fmi2Status unit_poll(Unit* unit) { return refuse(unit, "asking for the status"); }
