// Everything that OpenImageIO reads, behind the C interface of oiio_module.h.
#include "image/module/oiio_module.h"

#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "image/srgb.h"

namespace {

using namespace shoal::oiio;  // NOLINT: the whole file implements it

// How the samples are fetched from OpenImageIO. 8 and 16 bits come as they are stored, and a table
// makes them numbers; wider integers come as floats in [0, 1].
enum class Fetch { uint8, uint16, wide_integer, floating };

Fetch fetch_for(OIIO::TypeDesc type) {
  if (type.is_floating_point()) return Fetch::floating;
  if (type == OIIO::TypeDesc::UINT8) return Fetch::uint8;
  if (type == OIIO::TypeDesc::UINT16) return Fetch::uint16;
  return Fetch::wide_integer;
}

OIIO::TypeDesc fetched_type(Fetch fetch) {
  if (fetch == Fetch::uint8) return OIIO::TypeDesc::UINT8;
  if (fetch == Fetch::uint16) return OIIO::TypeDesc::UINT16;
  return OIIO::TypeDesc::FLOAT;
}

float decode(double value, IntegerEncoding encoding) {
  return static_cast<float>(encoding == kIntegerSrgb ? shoal::srgb_to_linear(value) : value);
}

std::vector<float> decoding_table(int largest, IntegerEncoding encoding) {
  std::vector<float> table(static_cast<std::size_t>(largest) + 1);
  for (int v = 0; v <= largest; ++v) table[v] = decode(static_cast<double>(v) / largest, encoding);
  return table;
}

void say(Message* message, const std::string& text) {
  std::snprintf(message->text, sizeof message->text, "%s", text.c_str());
}

template <std::size_t kSize>
void copy_text(char (&to)[kSize], const std::string& from) {
  std::snprintf(to, kSize, "%s", from.c_str());
}

}  // namespace

namespace shoal::oiio {

struct Picture {
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  Fetch fetch = Fetch::floating;
  IntegerEncoding encoding = kIntegerSrgb;
  std::vector<float> table;            // of 8- and 16-bit samples
  int channel_count = 0;               // the file's first ones: red, green, blue, or grey
  std::vector<std::byte> interleaved;  // as OpenImageIO delivers
};

}  // namespace shoal::oiio

namespace {

// 0 where there is neither colour nor grey. OpenImageIO puts colours first in every format.
int colour_channels(const OIIO::ImageSpec& spec) {
  if (spec.nchannels >= 3) return 3;
  return spec.nchannels == 1 || spec.alpha_channel == 1 ? 1 : 0;
}

Outcome check_kind(const Picture& picture, Message* message) {
  const auto& spec = picture.spec;
  const char* fault = nullptr;
  if (spec.deep) fault = "is a deep picture";
  if (spec.depth > 1) fault = "is a volume";
  if (picture.channel_count == 0) fault = "has neither three colours nor one grey";
  if (!fault) return kOutcomeOk;
  say(message, fault);
  return kOutcomeUnsupported;
}

void fill_facts(const Picture& picture, Facts* facts) {
  const auto& spec = picture.spec;
  *facts = {};
  facts->width = spec.width;
  facts->height = spec.height;
  facts->channel_count = picture.channel_count;
  facts->row_quantum = spec.tile_width > 0 ? spec.tile_height : 1;
  facts->is_integer = picture.fetch != Fetch::floating;
  facts->orientation = spec.get_int_attribute("Orientation", 1);
  // A DDS cube map, of which the frame is one face. With faces missing it is no whole strip.
  facts->is_cube = spec.get_string_attribute("textureformat") == "CubeFace Environment" &&
                   spec.height == 6 * spec.width;
  facts->is_cropped = spec.x != spec.full_x || spec.y != spec.full_y ||
                      spec.width != spec.full_width || spec.height != spec.full_height;
  copy_text(facts->format, std::string(picture.input->format_name()) + ' ' + spec.format.c_str());
  copy_text(facts->colour_space, std::string(spec.get_string_attribute("oiio:ColorSpace")));
}

Outcome open_picture(const char* path, IntegerEncoding encoding, Picture** out, Facts* facts,
                     Message* message) {
  // The engine's own workers share the cores; more threads below them would only get in their way.
  OIIO::attribute("threads", 1);
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] =
      1;  // alpha is ignored, so colours are not to be multiplied by it
  auto picture = std::make_unique<Picture>();
  picture->input = OIIO::ImageInput::open(path, &wishes);
  if (!picture->input) {
    say(message, OIIO::geterror());
    const auto reader = OIIO::ImageInput::create(path);
    OIIO::geterror();  // what create() may have added
    return reader ? kOutcomeMalformed : kOutcomeUnsupported;
  }
  picture->spec = picture->input->spec();
  picture->encoding = encoding;
  picture->channel_count = colour_channels(picture->spec);
  if (const Outcome outcome = check_kind(*picture, message); outcome != kOutcomeOk) return outcome;
  picture->fetch = fetch_for(picture->spec.format);
  if (picture->fetch == Fetch::uint8) picture->table = decoding_table(0xff, encoding);
  if (picture->fetch == Fetch::uint16) picture->table = decoding_table(0xffff, encoding);
  fill_facts(*picture, facts);
  *out = picture.release();
  return kOutcomeOk;
}

template <typename Sample, typename Decode>
void split(const Picture& picture, std::size_t pixel_count, float* planes, Decode decode_sample) {
  const auto* samples = reinterpret_cast<const Sample*>(picture.interleaved.data());
  const auto step = static_cast<std::size_t>(picture.channel_count);
  for (std::size_t c = 0; c < step; ++c, planes += pixel_count) {
    for (std::size_t i = 0; i < pixel_count; ++i) planes[i] = decode_sample(samples[i * step + c]);
  }
}

bool fetch_rows(Picture& picture, int row_begin, int row_end) {
  const auto& spec = picture.spec;
  const auto type = fetched_type(picture.fetch);
  picture.interleaved.resize(static_cast<std::size_t>(row_end - row_begin) * spec.width *
                             picture.channel_count * type.size());
  const int y_begin = spec.y + row_begin, y_end = spec.y + row_end;
  if (spec.tile_width > 0) {
    return picture.input->read_tiles(0, 0, spec.x, spec.x + spec.width, y_begin, y_end, spec.z,
                                     spec.z + 1, 0, picture.channel_count, type,
                                     picture.interleaved.data());
  }
  return picture.input->read_scanlines(0, 0, y_begin, y_end, spec.z, 0, picture.channel_count, type,
                                       picture.interleaved.data());
}

Outcome read_picture_rows(Picture* picture, std::int32_t row_begin, std::int32_t row_end,
                          float* planes, Message* message) {
  if (!fetch_rows(*picture, row_begin, row_end)) {
    const auto reason = picture->input->geterror();
    say(message, reason.empty() ? "the file's reader gives no reason" : reason);
    return kOutcomeMalformed;
  }
  const auto pixel_count =
      static_cast<std::size_t>(row_end - row_begin) * static_cast<std::size_t>(picture->spec.width);
  const auto look_up = [&](auto sample) { return picture->table[sample]; };
  switch (picture->fetch) {
    case Fetch::uint8:
      split<std::uint8_t>(*picture, pixel_count, planes, look_up);
      break;
    case Fetch::uint16:
      split<std::uint16_t>(*picture, pixel_count, planes, look_up);
      break;
    case Fetch::wide_integer:
      split<float>(*picture, pixel_count, planes,
                   [&](float sample) { return decode(sample, picture->encoding); });
      break;
    case Fetch::floating:
      split<float>(*picture, pixel_count, planes, [](float sample) { return sample; });
      break;
  }
  return kOutcomeOk;
}

// Exceptions end here.
template <auto kFunction, typename... Arguments>
Outcome guarded(Arguments... arguments, Message* message) {
  try {
    return kFunction(arguments..., message);
  } catch (const std::exception& exception) {
    say(message, exception.what());
  } catch (...) {
    say(message, "an exception of no known kind");
  }
  return kOutcomeMalformed;
}

Outcome guarded_open(const char* path, IntegerEncoding encoding, Picture** picture, Facts* facts,
                     Message* message) {
  return guarded<open_picture, const char*, IntegerEncoding, Picture**, Facts*>(
      path, encoding, picture, facts, message);
}

Outcome guarded_read(Picture* picture, std::int32_t row_begin, std::int32_t row_end, float* planes,
                     Message* message) {
  return guarded<read_picture_rows, Picture*, std::int32_t, std::int32_t, float*>(
      picture, row_begin, row_end, planes, message);
}

void close_picture(Picture* picture) { delete picture; }

constexpr Module kModule = {kInterfaceVersion, guarded_open, guarded_read, close_picture};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* shoal_oiio_module() {
  return &kModule;
}
