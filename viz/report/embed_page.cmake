# Makes OUTPUT, a C++ file that holds the page as bytes, of TEMPLATE, STYLE and SCRIPTS (joined by "|").
# @STYLE@ and @SCRIPT@ in the template become the files' texts; @STYLE_HASH@ and @SCRIPT_HASH@ what a
# Content-Security-Policy calls them: sha256-BASE64.
cmake_minimum_required(VERSION 3.25)

# The hash's 64 hexadecimal digits as base64: three bytes are four characters, the last two are three.
function(content_policy_hash out text)
  set(alphabet ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  string(SHA256 digits "${text}")
  string(APPEND digits 00)
  set(base64 "")
  foreach(begin RANGE 0 60 6)
    string(SUBSTRING ${digits} ${begin} 6 part)
    foreach(shift 18 12 6 0)
      math(EXPR index "(0x${part} >> ${shift}) & 63")
      string(SUBSTRING ${alphabet} ${index} 1 character)
      string(APPEND base64 ${character})
    endforeach()
  endforeach()
  string(SUBSTRING ${base64} 0 43 base64)
  set(${out} "sha256-${base64}=" PARENT_SCOPE)
endfunction()

file(READ "${TEMPLATE}" page)
file(READ "${STYLE}" style)
set(script "")
string(REPLACE "|" ";" scripts "${SCRIPTS}")
foreach(file IN LISTS scripts)
  file(READ "${file}" text)
  string(APPEND script "${text}")
endforeach()
content_policy_hash(style_hash "${style}")
content_policy_hash(script_hash "${script}")
string(REPLACE "@STYLE_HASH@" "${style_hash}" page "${page}")
string(REPLACE "@SCRIPT_HASH@" "${script_hash}" page "${page}")
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")

string(HEX "${page}" bytes)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE "${OUTPUT}" "#include \"report/page.h\"

namespace shoal::viz {
namespace {

constexpr unsigned char kBytes[] = {${bytes}};

}  // namespace

std::string_view page_template() {
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes)};
}

}  // namespace shoal::viz
")
