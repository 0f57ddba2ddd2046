// Python, for units that embed it and are not linked with its library.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_PYTHON_LIBRARY_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_PYTHON_LIBRARY_H

#include <string>
#include <string_view>

namespace stride::importer {

/// Whether the symbol is one of Python's library: Py_IsInitialized, PyExc_RuntimeError,
/// _Py_NoneStruct, …
bool is_of_python(std::string_view symbol);

/// Whether this is a name of Python's library: "libpython3.11.so.1.0".
bool is_python_library(std::string_view name);

/// Loads Python's library with its symbols for all libraries that are loaded later, and returns its
/// name; empty if the loader finds none. The newest one counts that is installed, and it stays
/// until the process ends. Its initialization runs with this call.
std::string load_python();

}  // namespace stride::importer

#endif
