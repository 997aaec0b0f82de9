#include "report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/mat3x3.hpp>

#include "library/viewpoint.h"
#include "report/picture.h"
#include "report/script_text.h"
#include "sphere/irradiance.h"

namespace shoal::viz {
namespace {

// Of the polynomials in irradiance_ball's order: Y_lm = factor * polynomial.
constexpr std::array<double, 9> kPolynomialFactors = {
    0.28209479177387814, 0.48860251190291992, 0.48860251190291992,
    0.48860251190291992, 1.0925484305920792,  1.0925484305920792,
    0.31539156525252005, 1.0925484305920792,  0.54627421529603959};

constexpr std::array kQuantities = {Quantity::radiance, Quantity::irradiance,
                                    Quantity::irradiance_over_pi};

std::string vector_text(const glm::dvec3& v) {
  return short_numbers(std::array<double, 3>{v.x, v.y, v.z});
}

std::string optional_number(const std::optional<double>& value) {
  return value ? short_number(*value) : "null";
}

std::string strings(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) {
    if (out.size() > 1) out += ',';
    out += script_quoted(text);
  }
  return out + ']';
}

// Where the picture's centre, right and upper edge lie in the frame, and from where one first
// looks.
std::string frame_data(const Frame& frame) {
  return fmt::format(R"({{"text":{},"center":{},"right":{},"up":{},"viewer":{}}})",
                     script_quoted(text_of(frame)), vector_text(direction_of(frame.center)),
                     vector_text(direction_of(frame.right)), vector_text(direction_of(frame.up)),
                     vector_text(viewer_direction(frame)));
}

// The names are those of the table of quality.
std::string figures_data(const LightFigures& figures, const Frame& frame) {
  const QualityFigures& quality = figures.quality;
  std::string out = fmt::format(
      R"({{"mean":{},"mean_rgb":{},"contrast":{},"directionality":{},"minimum_irradiance":{},)"
      R"("negative_fraction":{},"rms_error":{},"max_error":{},"key_temperature":{},)"
      R"("fill_temperature":{})",
      short_number(figures.mean_luminance), vector_text(figures.mean),
      optional_number(quality.contrast), optional_number(quality.directionality),
      optional_number(quality.minimum_irradiance), short_number(quality.negative_fraction),
      optional_number(quality.rms_error), optional_number(quality.max_error),
      optional_number(quality.key_temperature), optional_number(quality.fill_temperature));
  if (figures.direction) {
    out += fmt::format(R"(,"direction":{},"elevation":{},"azimuth":{})",
                       vector_text(native_to_frame(frame) * *figures.direction),
                       short_number(elevation_of(*figures.direction)),
                       short_number(azimuth_of(*figures.direction)));
  }
  return out + '}';
}

std::string pixels_data(const PixelFigures& pixels) {
  return fmt::format(
      R"({{"format":{},"width":{},"height":{},"count":{},"nonfinite":{},"negative":{},)"
      R"("clamped":{},"minimum":{},"maximum":{},"mean":{}}})",
      script_quoted(pixels.format), pixels.width, pixels.height, pixels.pixel_count,
      pixels.nonfinite_count, pixels.negative_count, pixels.clamped_count,
      short_numbers(pixels.minimum), short_numbers(pixels.maximum), short_numbers(pixels.mean));
}

// `frame` is the place of the entry's among the frames.
std::string entry_data(const IndexEntry& entry, std::size_t frame) {
  const Panorama& panorama = *entry.panorama;
  return fmt::format(
      R"({{"name":{},"variant":{},"file":{},"quantity":{},"degree":{},"frame":{},"changed":{},)"
      R"("tags":{},"warnings":{},"thumbnail":{},"ball":{},"exposure":{},"figures":{},"pixels":{}}})",
      script_quoted(entry.name), script_quoted(panorama.variant),
      script_quoted(panorama.file.filename().string()), script_quoted(name_of(panorama.quantity)),
      panorama.coefficients.degree, frame, !panorama.change.is_whole, strings(panorama.tags),
      strings(entry.warnings), script_quoted(entry.thumbnail), entry.ball,
      short_number(entry.exposure), figures_data(entry.figures, entry.frame),
      panorama.pixels ? pixels_data(*panorama.pixels) : "null");
}

// r g b of every coefficient as little-endian doubles, whatever the machine's order is.
std::string coefficient_bytes(const Coefficients& coefficients) {
  std::string bytes;
  for (std::size_t i = 0; i < coefficients.channels[0].size(); ++i) {
    for (const auto& channel : coefficients.channels) {
      const auto bits = std::bit_cast<std::uint64_t>(channel[i]);
      for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift & 255u);
    }
  }
  return bytes;
}

}  // namespace

std::string irradiance_ball(const Coefficients& radiance) {
  const Coefficients light = apply_quantity(radiance, Quantity::irradiance_over_pi);
  std::string out = "[";
  for (std::size_t i = 0; i < kPolynomialFactors.size() && i < light.channels[0].size(); ++i) {
    if (i > 0) out += ',';
    glm::dvec3 factor(0.0);
    for (int c = 0; c < 3; ++c) factor[c] = kPolynomialFactors[i] * light.channels[c][i];
    out += vector_text(factor);
  }
  return out + ']';
}

std::string index_data(const Library& library, const std::vector<IndexEntry>& entries,
                       const std::vector<FailedPanorama>& failed, const std::string& inlined) {
  std::vector<Frame> frames;
  std::string frame_list;
  std::string entry_list;
  for (const IndexEntry& entry : entries) {
    const auto place =
        static_cast<std::size_t>(std::ranges::find(frames, entry.frame) - frames.begin());
    if (place == frames.size()) {
      frame_list += (frames.empty() ? "" : ",") + frame_data(entry.frame);
      frames.push_back(entry.frame);
    }
    entry_list += (entry_list.empty() ? "\n" : ",\n") + entry_data(entry, place);
  }
  std::string out = fmt::format("{{\"title\":{},\"plain\":{},\"frames\":[{}],\n\"panoramas\":[{}",
                                script_quoted(library.title), script_quoted(kPlainVariant),
                                frame_list, entry_list);
  out += "],\n\"failed\":[";
  for (std::size_t i = 0; i < failed.size(); ++i) {
    out += fmt::format("{}\n{{\"name\":{},\"error\":{}}}", i == 0 ? "" : ",",
                       script_quoted(failed[i].name), script_quoted(failed[i].error));
  }
  return out + "],\n\"inline\":" + (inlined.empty() ? "null" : inlined) + "}\n";
}

std::string panorama_data(const Panorama& panorama, const Frame& frame, const Pixels& pixels,
                          const std::string& note) {
  std::string rgbe;
  if (!pixels.empty()) rgbe = base64(compressed_planes(rgbe_planes(pixels), pixels.width));
  std::string out = fmt::format(R"({{"width":{},"height":{},"rgbe":"{}","note":{},"native":"{}")",
                                pixels.width, pixels.height, rgbe, script_quoted(note),
                                base64(coefficient_bytes(radiance_of(panorama))));
  for (const Quantity quantity : kQuantities) {
    out += fmt::format(",\n\"{}\":\"{}\"", name_of(quantity),
                       exact_coefficients(coefficients_in(panorama, quantity, frame)));
  }
  return out + '}';
}

}  // namespace shoal::viz
