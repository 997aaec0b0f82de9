// The border between the engine and the module that knows OpenEXR's C++ classes.
//
// The engine reads most EXR files by itself, so the module is a shared object of its own, loaded
// when the first file comes that needs it: linked to these classes, whose static constructors
// register OpenEXR's types, a program starts 1 ms later. No C++ type, exception or allocation
// crosses this border: module and engine may have a C++ runtime library each.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal::exr {

inline constexpr std::uint32_t kInterfaceVersion = 2;  // raised when anything below changes
inline constexpr char kModuleFile[] = "shoal_exr.so";
inline constexpr char kEntryPoint[] = "shoal_exr_module";

extern "C" {

enum Outcome : std::int32_t { kOutcomeOk = 0, kOutcomeFailed = 1 };

enum SampleKind : std::int32_t { kSampleHalf = 0, kSampleFloat = 1, kSampleUint = 2 };

struct Message {
  char text[512];  // ends with 0
};

// A file that the engine has opened. `read` fills `bytes` from `offset` or fails.
struct Input {
  const void* file;
  const char* name;  // for the library's messages
  std::uint64_t size;
  Outcome (*read)(const void* file, std::uint64_t offset, char* bytes, std::size_t count,
                  Message* message);
};

// What the engine has read in the header, and lays its memory out by. The module reads the header
// once more and refuses what differs.
struct Channel {
  const char* name;
  SampleKind kind;
  std::int32_t x_sampling;
  std::int32_t y_sampling;
};
struct Part {
  std::int32_t index;
  const char* layer;                            // of luminance/chroma channels; may be empty
  std::int32_t x_begin, y_begin, x_end, y_end;  // the data window
  const Channel* channels;
  std::size_t channel_count;
};

enum PictureKind : std::int32_t {
  kPicturePlanes = 0,           // any channels, as they are stored
  kPictureLuminanceChroma = 1,  // becomes half R, G, B, with the library's reconstruction filter
};

// Where a channel's samples go. `sample` is that of the first line and of the window's left border;
// lines lie row_stride bytes apart, samples beside each other.
struct Plane {
  const char* channel;  // of kPicturePlanes
  SampleKind kind;      // as stored, or half
  char* sample;
  std::ptrdiff_t row_stride;
};

struct Picture;  // the module's own

// What a map says of itself: nothing, or that it is an `envmap` CUBE.
enum Environment : std::int32_t { kEnvironmentNone = 0, kEnvironmentCube = 1 };

// A map to be written: ZIP, channels R, G, B.
struct Attribute {
  const char* name;
  const char* text;
};
struct MapHeader {
  std::int32_t width;
  std::int32_t height;
  SampleKind kind;  // half (beyond +-65504 becomes +-65504) or float (bit for bit)
  Environment environment;
  const Attribute* attributes;
  std::size_t attribute_count;
};

// Where its bytes go, in any order: what is written once may be overwritten.
struct Output {
  void* file;
  const char* name;  // for the library's messages
  Outcome (*write)(void* file, std::uint64_t offset, const char* bytes, std::size_t count,
                   Message* message);
};

struct Map;  // the module's own

struct Module {
  std::uint32_t interface_version;

  // `input.file` must outlive the picture, which is to be closed when kOutcomeOk comes back.
  Outcome (*open_picture)(PictureKind kind, const Part* part, const Input* input, Picture** picture,
                          Message* message);
  // Lines [line_begin, line_end) of the data window, in the file's own numbers.
  // kPictureLuminanceChroma wants three planes: red, green, blue.
  Outcome (*read_lines)(Picture* picture, std::int32_t line_begin, std::int32_t line_end,
                        const Plane* planes, std::size_t plane_count, Message* message);
  void (*close_picture)(Picture* picture);

  // `output.file` must outlive the map, which is to be closed when kOutcomeOk comes back.
  Outcome (*create_map)(const MapHeader* header, const Output* output, Map** map, Message* message);
  // The next row_count rows: red, green and blue, each from the first sample of the first row,
  // `stride` floats from a row to the next.
  Outcome (*write_rows)(Map* map, const float* const planes[3], std::ptrdiff_t stride,
                        std::int32_t row_count, Message* message);
  // After the last row: writes what comes behind the rows.
  Outcome (*finish_map)(Map* map, Message* message);
  void (*close_map)(Map* map);
};

using EntryPoint = const Module* (*)();

}  // extern "C"
}  // namespace shoal::exr
