#include "master/importer/python_library.h"

#include <catch2/catch.hpp>

using namespace stride::importer;

TEST_CASE("symbols of Python's library are known by their names") {
  for (const char* symbol :
       {"Py_IsInitialized", "PyExc_RuntimeError", "_Py_NoneStruct", "PyList_New"}) {
    CHECK(is_of_python(symbol));
  }
  for (const char* symbol : {"Pyramid", "Py", "", "_", "python_start", "fmi2DoStep"}) {
    CHECK_FALSE(is_of_python(symbol));
  }
}
