// The border between the engine and the module that knows OpenImageIO.
//
// The module is a shared object of its own, loaded when the first file comes that needs it: linked
// to OpenImageIO, a program loads hundreds of shared objects at every start. No C++ type, exception
// or allocation crosses this border, so module and engine may come from different compilers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal::oiio {

inline constexpr std::uint32_t kInterfaceVersion = 2;  // raised when anything below changes
inline constexpr char kModuleFile[] = "shoal_oiio.so";
inline constexpr char kEntryPoint[] = "shoal_oiio_module";

extern "C" {

enum Outcome : std::int32_t {
  kOutcomeOk = 0,
  kOutcomeUnsupported = 1,  // no reader for such a file, or a kind of picture that is no panorama
  kOutcomeMalformed = 2,    // the reader refuses or breaks off
};

// How integer samples become numbers. Floating-point samples are passed on as they are.
enum IntegerEncoding : std::int32_t {
  kIntegerLinear = 0,  // v / largest
  kIntegerSrgb = 1,    // the same, then linearised by IEC 61966-2-1
};

struct Facts {
  std::int32_t width;
  std::int32_t height;
  std::int32_t channel_count;  // 3 or 1: what read_rows() delivers
  std::int32_t row_quantum;    // height of a tile, or 1; row_begin must be a multiple of it
  std::int32_t is_integer;
  std::int32_t orientation;  // as in EXIF: 1 is upright
  std::int32_t is_cropped;   // the stored pixels are not the picture's whole frame
  std::int32_t is_cube;      // six square faces one below the other, +x -x +y -y +z -z
  char format[64];           // for people: "png uint8"
  char colour_space[64];     // what the file says of itself; may be empty
};

struct Message {
  char text[512];  // ends with 0
};

struct Picture;  // the module's own

struct Module {
  std::uint32_t interface_version;

  // Opens the first picture of a file. `*picture` is to be closed when kOutcomeOk comes back.
  Outcome (*open)(const char* path, IntegerEncoding encoding, Picture** picture, Facts* facts,
                  Message* message);

  // Rows [row_begin, row_end), row_begin a multiple of row_quantum, row_end that or the height:
  // channel_count planes of (row_end - row_begin) * width floats, one behind the other. Rows are
  // best read from the top down.
  Outcome (*read_rows)(Picture* picture, std::int32_t row_begin, std::int32_t row_end,
                       float* planes, Message* message);

  void (*close)(Picture* picture);
};

using EntryPoint = const Module* (*)();

}  // extern "C"
}  // namespace shoal::oiio
