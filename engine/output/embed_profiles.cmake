# Makes OUTPUT, a C++ file that holds the texts of PROFILES (files joined by "|") under their names.
cmake_minimum_required(VERSION 3.25)

string(REPLACE "|" ";" files "${PROFILES}")
set(entries "")
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  file(READ "${file}" text)
  string(FIND "${text}" ")shoal\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${file} holds what ends its own literal")
  endif()
  string(APPEND entries "    {\"${name}\", R\"shoal(${text})shoal\"},\n")
endforeach()

file(WRITE "${OUTPUT}" "#include \"output/builtin_profiles.h\"

namespace shoal {
namespace {

constexpr BuiltinProfile kProfiles[] = {
${entries}};

}  // namespace

std::span<const BuiltinProfile> builtin_profiles() { return kProfiles; }

}  // namespace shoal
")
