#include "master/loader/fmu/library/python_library.h"

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

TEST_CASE("Python's library is known by its name") {
  CHECK(is_python_library("libpython3.11.so.1.0"));
  CHECK(is_python_library("/usr/lib/libpython3.so"));
  CHECK_FALSE(is_python_library("libboost_python.so"));
}
