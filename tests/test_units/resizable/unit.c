/* y = gain * u, vectors of n elements, of which each has its own gain. n is a structural parameter:
 * it is set in Configuration Mode only, and every other call has to have as many values as it says.
 */
#include <string.h>

#include <stride/fmi3.h>

enum { N = 1, GAIN = 2, U = 3, Y = 4, MOST = 16 };

typedef struct {
  bool is_configured; /* it was in Configuration Mode, or kept what it is by default */
  bool is_configuring;
  size_t n;
  double gain[MOST], u[MOST];
} Model;

static void start(Model* m) {
  memset(m, 0, sizeof *m);
  for (size_t i = 0; i < MOST; ++i) m->gain[i] = 1;
}

#define fmi3GetFloat64 raw_get_float64
#define fmi3SetFloat64 raw_set_float64
#define fmi3SetUInt64 raw_set_uint64
#include "tests/test_units/raw/model.h"

fmi3Status fmi3EnterConfigurationMode(fmi3Instance handle) {
  Model* v = model(handle);
  if (v->is_configured) return fail(handle, "Configuration Mode after something was set");
  v->is_configuring = v->is_configured = true;
  return fmi3OK;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance handle) {
  model(handle)->is_configuring = false;
  return fmi3OK;
}

fmi3Status fmi3SetUInt64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                         const fmi3UInt64 values[], size_t size) {
  Model* v = model(handle);
  if (!v->is_configuring) return fail(handle, "n is set in Configuration Mode only");
  if (count != 1 || size != 1 || references[0] != N || values[0] > MOST) {
    return fail(handle, "this is not n");
  }
  v->n = values[0];
  return fmi3OK;
}

static size_t size_of(Model* v) {
  if (v->is_configured) return v->n;
  v->is_configured = true;
  return v->n = 2;
}

fmi3Status fmi3SetFloat64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t size) {
  Model* v = model(handle);
  const size_t n = size_of(v);
  if (size != count * n) return fail(handle, "another number of values than n says");
  for (size_t i = 0; i < size; ++i) {
    (references[i / n] == GAIN ? v->gain : v->u)[i % n] = values[i];
  }
  return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                          fmi3Float64 values[], size_t size) {
  Model* v = model(handle);
  const size_t n = size_of(v);
  if (size != count * n) return fail(handle, "another number of values than n says");
  for (size_t i = 0; i < size; ++i) {
    const size_t k = i % n;
    values[i] = references[i / n] == GAIN ? v->gain[k]
                : references[i / n] == U  ? v->u[k]
                                          : v->gain[k] * v->u[k];
  }
  return fmi3OK;
}

/* Of y by u. */
fmi3Status fmi3GetDirectionalDerivative(fmi3Instance handle, const fmi3ValueReference unknowns[],
                                        size_t n_unknowns, const fmi3ValueReference knowns[],
                                        size_t n_knowns, const fmi3Float64 seed[], size_t n_seed,
                                        fmi3Float64 sensitivity[], size_t n_sensitivity) {
  Model* v = model(handle);
  const size_t n = size_of(v);
  if (n_seed != n_knowns * n || n_sensitivity != n_unknowns * n) {
    return fail(handle, "another number of values than n says");
  }
  for (size_t i = 0; i < n_sensitivity; ++i) {
    sensitivity[i] = 0;
    for (size_t k = 0; k < n_knowns; ++k) {
      const bool depends = unknowns[i / n] == Y && knowns[k] == U;
      sensitivity[i] += depends ? v->gain[i % n] * seed[k * n + i % n] : 0;
    }
  }
  return fmi3OK;
}
