/* y = k * u, with variables of each kind that a connection may begin or end at: a fixed parameter,
 * which is set before the end of the initialisation only, a parameter that is calculated from it, a
 * constant, an enumeration whose items have blanks in their names, and a parameter and an output
 * whose names hold a '='.
 */
#include <stride/fmi3.h>

enum { K = 1, U = 4 };

typedef struct {
  bool is_initialized;
  double k, u, tuned;
  fmi3Int64 mode;
} Model;

static void start(Model* m) { *m = (Model){.k = 1, .mode = 1}; }

#define fmi3GetFloat64 raw_get_float64
#define fmi3SetFloat64 raw_set_float64
#define fmi3GetInt64 raw_get_int64
#define fmi3SetInt64 raw_set_int64
#define fmi3ExitInitializationMode raw_exit_initialization_mode
#include "tests/test_units/raw/model.h"

fmi3Status fmi3ExitInitializationMode(fmi3Instance handle) {
  model(handle)->is_initialized = true;
  return fmi3OK;
}

fmi3Status fmi3SetFloat64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t size) {
  Model* g = model(handle);
  for (size_t i = 0; i < count && size == count; ++i) {
    if (references[i] == K && g->is_initialized) {
      return fail(handle, "k is fixed");
    }
    *(references[i] == K ? &g->k : references[i] == U ? &g->u : &g->tuned) = values[i];
  }
  return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                          fmi3Float64 values[], size_t size) {
  const Model* g = model(handle);
  for (size_t i = 0; i < count && size == count; ++i) {
    const double all_values[] = {0, g->k, 2 * g->k, 7, g->u, g->k * g->u, g->tuned, g->tuned};
    values[i] = all_values[references[i]];
  }
  return fmi3OK;
}

fmi3Status fmi3SetInt64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                        const fmi3Int64 values[], size_t size) {
  (void)references;
  for (size_t i = 0; i < count && size == count; ++i) model(handle)->mode = values[i];
  return fmi3OK;
}

fmi3Status fmi3GetInt64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                        fmi3Int64 values[], size_t size) {
  (void)references;
  for (size_t i = 0; i < count && size == count; ++i) values[i] = model(handle)->mode;
  return fmi3OK;
}
