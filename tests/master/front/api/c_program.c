/* A program in C that simulates an FMU by libstride: argument 1, the minimal unit. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <stride/master.h>

#define CHECK(condition)                                                                        \
  do {                                                                                          \
    if (!(condition)) {                                                                         \
      fprintf(stderr, "line %d: %s; %s\n", __LINE__, #condition, stride_last_error()->message); \
      return 1;                                                                                 \
    }                                                                                           \
  } while (0)

static int count_calls(void* user, stride_time time) {
  (void)time;
  ++*(int*)user;
  return 0;
}

int main(int argc, char** argv) {
  const stride_setting settings[] = {
      {"set", "minimal.time_constant=0.5"}, {"stop", "2"}, {"step", "0.25"}};
  int calls = 0;
  stride_options options = {0};
  stride_simulation* simulation = NULL;
  size_t input = 0, output = 0;
  double value = 0;

  CHECK(argc == 2);
  CHECK(stride_open("missing.ssd", NULL, &simulation) == STRIDE_INVALID_INPUT);
  CHECK(simulation == NULL);
  CHECK(strstr(stride_last_error()->message, "missing.ssd") != NULL);

  options.size = sizeof(options);
  options.settings = settings;
  options.setting_count = sizeof(settings) / sizeof(settings[0]);
  options.progress = count_calls;
  options.user = &calls;
  CHECK(stride_open(argv[1], &options, &simulation) == STRIDE_OK);
  CHECK(stride_find(simulation, "minimal.u", &input) == STRIDE_OK);
  CHECK(stride_find(simulation, "minimal.y", &output) == STRIDE_OK);

  value = 1;
  CHECK(stride_set(simulation, input, &value, 1) == STRIDE_OK);
  CHECK(stride_advance(simulation, stride_seconds(1)) == STRIDE_OK);
  CHECK(stride_now(simulation).seconds == 1);
  CHECK(stride_get(simulation, output, &value, 1) == STRIDE_OK);
  CHECK(fabs(value - (1 - exp(-2))) < 1e-12);

  CHECK(stride_advance(simulation, stride_end_of_time()) == STRIDE_OK);
  CHECK(stride_is_over(simulation) && stride_now(simulation).seconds == 2);
  CHECK(stride_end(simulation) == STRIDE_OK);
  CHECK(strcmp(stride_end_reason(simulation), "completed") == 0);
  stride_close(simulation);
  return 0;
}
