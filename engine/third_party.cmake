# Other people's libraries, by the names third_party::NAME.
#
# What a library costs at every start of `shoal`, measured: 0.1 ms for being shared (looked up, mapped,
# relocated), 0.7 ms for libstdc++, 1 ms for OpenEXR's C++ classes, 0.2 s for OpenImageIO. So what the program
# itself needs is linked from archives where the system has them, and the last two live in modules
# (image/module/): 1.5 ms for `shoal --version` in place of 4.5.
option(SHOAL_STATIC_LIBRARIES "Link archives of third-party libraries where there are any, for a faster start" ON)

include(CheckCXXSourceCompiles)
include(CheckLinkerFlag)

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
find_package(hwy REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(PNG REQUIRED)
pkg_check_modules(libdeflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)

# third_party_library(NAME TARGET FILE ARCHIVE PROBE [NEEDS...])
# third_party::NAME is the ARCHIVE (a file name) that lies beside FILE, the library that TARGET stands for;
# where there is none, or a program of PROBE does not link with it (an archive that is not position
# independent, say), it is TARGET. Sets third_party_NAME_is_archive.
function(third_party_library name target file archive probe)
  cmake_path(GET file PARENT_PATH folder)
  add_library(third_party_${name} INTERFACE)
  add_library(third_party::${name} ALIAS third_party_${name})
  set(links OFF)
  if(SHOAL_STATIC_LIBRARIES AND EXISTS ${folder}/${archive})
    get_target_property(includes ${target} INTERFACE_INCLUDE_DIRECTORIES)
    if(NOT includes)
      set(includes "")
    endif()
    set(CMAKE_REQUIRED_INCLUDES ${includes})
    set(CMAKE_REQUIRED_LIBRARIES ${folder}/${archive} ${ARGN})
    check_cxx_source_compiles("${probe}" third_party_${name}_links)
    set(links ${third_party_${name}_links})
  endif()
  if(links)
    add_library(third_party_${name}_archive STATIC IMPORTED GLOBAL)
    set_target_properties(third_party_${name}_archive PROPERTIES
      IMPORTED_LOCATION ${folder}/${archive} INTERFACE_INCLUDE_DIRECTORIES "${includes}"
      INTERFACE_LINK_LIBRARIES "${ARGN}")
    target_link_libraries(third_party_${name} INTERFACE third_party_${name}_archive)
  else()
    target_link_libraries(third_party_${name} INTERFACE ${target})
  endif()
  set(third_party_${name}_is_archive ${links} PARENT_SCOPE)
endfunction()

list(GET PNG_LIBRARIES 0 png_file)
get_target_property(yaml_file yaml-cpp LOCATION)
third_party_library(deflate PkgConfig::libdeflate ${libdeflate_LINK_LIBRARIES} libdeflate.a
  "#include <libdeflate.h>
  int main() { return libdeflate_alloc_decompressor() == nullptr; }")
third_party_library(xxhash PkgConfig::xxhash ${xxhash_LINK_LIBRARIES} libxxhash.a
  "#include <xxhash.h>
  int main() { return XXH3_createState() == nullptr; }")
third_party_library(png PNG::PNG ${png_file} libpng.a
  "#include <png.h>
  int main() { return png_create_write_struct(\"\", nullptr, nullptr, nullptr) == nullptr; }"
  ZLIB::ZLIB m)
third_party_library(sqlite SQLite::SQLite3 ${SQLite3_LIBRARIES} libsqlite3.a
  "#include <sqlite3.h>
  int main() { return sqlite3_initialize(); }"
  Threads::Threads ${CMAKE_DL_LIBS} m)
third_party_library(yaml yaml-cpp ${yaml_file} libyaml-cpp.a
  "#include <yaml-cpp/yaml.h>
  int main() { return YAML::Load(\"0\").as<int>(); }")

# Debian has no archive of fmt, but what its library is made of: 9.x is compiled here, once; other
# versions are compiled into every file that uses them, which takes a compiler 3 s a file.
if(NOT SHOAL_STATIC_LIBRARIES)
  add_library(third_party_fmt INTERFACE)
  target_link_libraries(third_party_fmt INTERFACE fmt::fmt)
elseif(fmt_VERSION VERSION_GREATER_EQUAL 9 AND fmt_VERSION VERSION_LESS 10)
  add_library(third_party_fmt STATIC core/fmt_archive.cpp)
  get_target_property(fmt_includes fmt::fmt-header-only INTERFACE_INCLUDE_DIRECTORIES)
  target_include_directories(third_party_fmt SYSTEM PUBLIC ${fmt_includes})
else()
  add_library(third_party_fmt INTERFACE)
  target_link_libraries(third_party_fmt INTERFACE fmt::fmt-header-only)
endif()
add_library(third_party::fmt ALIAS third_party_fmt)

# third_party::runtime, for the program alone: libstdc++ inside, once no C++ library is left outside.
# Modules and the libraries behind them bring the shared one. The two never meet, because only C crosses the
# modules' borders, and the program exports no symbol that a module could take for its own (--exclude-libs;
# tests/cli/modules_test.py looks). Sanitizers have to stand between a program and its runtime library, so
# they get the shared one.
add_library(third_party_runtime INTERFACE)
add_library(third_party::runtime ALIAS third_party_runtime)
if(SHOAL_STATIC_LIBRARIES AND third_party_yaml_is_archive AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(CMAKE_REQUIRED_LINK_OPTIONS -static-libstdc++ -static-libgcc LINKER:--exclude-libs,ALL)
  check_cxx_source_compiles(
    "#include <iostream>
    int main() { try { throw 1; } catch (int) { std::cout << 1; } }" third_party_runtime_links)
  if(third_party_runtime_links)
    target_link_options(third_party_runtime INTERFACE ${CMAKE_REQUIRED_LINK_OPTIONS})
  endif()
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
endif()
