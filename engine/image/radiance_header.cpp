#include "image/radiance_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "image/radiance_rle.h"

namespace shoal {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1 << 16;  // real headers take a few hundred bytes
constexpr std::string_view kFormatKey = "FORMAT=";
constexpr std::string_view kSpaces = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

// Takes the next word off the front of `text`.
std::string_view next_word(std::string_view& text) {
  text = trimmed(text);
  const auto word = text.substr(0, text.find_first_of(kSpaces));
  text.remove_prefix(word.size());
  return word;
}

// Exactly as many numbers as `values` has, or nothing. Independent of the locale, unlike strtod.
bool parse_numbers(std::string_view text, std::span<double> values) {
  for (double& value : values) {
    auto word = next_word(text);
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc{} || end != word.data() + word.size()) return false;
  }
  return trimmed(text).empty();
}

// For messages: no control characters, and not endless.
std::string quoted(std::string_view text) {
  std::string safe(text.substr(0, 60));
  std::replace_if(
      safe.begin(), safe.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return '"' + safe + '"';
}

// Radiance's default of unstated primaries is not Rec.709 either, but everybody who writes
// panoramas means Rec.709; so only primaries that are stated, and differ, are worth a word.
// Photoshop states eight zeros.
bool means_rec709(const std::array<double, 8>& primaries) {
  constexpr std::array<double, 8> kRec709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
  constexpr double kPrintedDigits = 0.002;  // headers round to two or three digits
  const auto near = [](double a, double b) { return std::abs(a - b) < kPrintedDigits; };
  return std::equal(primaries.begin(), primaries.end(), kRec709.begin(), near) ||
         std::all_of(primaries.begin(), primaries.end(), [](double v) { return v == 0.0; });
}

// Collects what the variables of a header say. Indented lines are the history of older files that
// went into this one, and say nothing about it.
class Variables {
 public:
  Status take(std::string_view line, const std::string& path) {
    if (line.starts_with(kFormatKey)) return take_format(line.substr(kFormatKey.size()), path);
    if (line.starts_with("EXPOSURE=")) take_exposure(line.substr(9));
    if (line.starts_with("COLORCORR=")) take_correction(line.substr(10));
    if (line.starts_with("PRIMARIES=")) take_primaries(line.substr(10));
    return {};
  }

  void finish(RadianceHeader& header) {
    if (!format_seen_) warn("the header has no FORMAT line; RGBE is assumed");
    header.colour = colour_;
    glm::dmat3 undo{1.0};
    for (int c = 0; c < 3; ++c) undo[c][c] = 1.0 / multiplied_[c];
    const bool is_xyze = colour_ == RadianceColour::xyze;
    header.to_linear_rec709 = is_xyze ? xyz_to_rec709() * undo : undo;
    if (is_xyze) {
      warn(
          "the XYZE samples are photometric (candela per square metre): a picture that Radiance "
          "converted from RGBE comes out 179 times as bright as its original");
    }
    header.warnings = std::move(warnings_);
  }

 private:
  void warn(std::string text) {
    constexpr std::size_t kEnough = 8;  // a header of nonsense has thousands
    if (warnings_.size() < kEnough) warnings_.push_back(std::move(text));
  }

  Status take_format(std::string_view value, const std::string& path) {
    value = trimmed(value);
    format_seen_ = true;
    if (value == "32-bit_rle_rgbe") {
      colour_ = RadianceColour::rgbe;
    } else if (value == "32-bit_rle_xyze") {
      colour_ = RadianceColour::xyze;
    } else {
      return Error{ErrorCode::unsupported, "has the Radiance format " + quoted(value), path,
                   "32-bit_rle_rgbe and 32-bit_rle_xyze are read"};
    }
    return {};
  }

  void take_exposure(std::string_view value) {
    double factor = 0.0;
    if (!parse_numbers(value, {&factor, 1}) || !multiply({factor, factor, factor})) {
      warn("EXPOSURE=" + quoted(trimmed(value)) + " is no exposure and is ignored");
    }
  }

  void take_correction(std::string_view value) {
    std::array<double, 3> factors{};
    if (!parse_numbers(value, factors) || !multiply(factors)) {
      warn("COLORCORR=" + quoted(trimmed(value)) + " is no colour correction and is ignored");
    }
  }

  // False, and no change, when the samples could not be divided by what comes out.
  bool multiply(const std::array<double, 3>& factors) {
    auto products = multiplied_;
    for (int c = 0; c < 3; ++c) {
      products[c] *= factors[c];
      const bool has_inverse = std::isnormal(products[c]) && std::isnormal(1.0 / products[c]);
      if (!(products[c] > 0.0) || !has_inverse) return false;
    }
    multiplied_ = products;
    return true;
  }

  void take_primaries(std::string_view value) {
    std::array<double, 8> primaries{};
    if (parse_numbers(value, primaries) && means_rec709(primaries)) return;
    warn("PRIMARIES=" + quoted(trimmed(value)) + " is ignored; colours are taken as Rec.709");
  }

  RadianceColour colour_ = RadianceColour::rgbe;
  bool format_seen_ = false;
  std::array<double, 3> multiplied_ = {1.0, 1.0, 1.0};  // what the samples were, so far
  std::vector<std::string> warnings_;
};

struct Axis {
  char name = 0;  // 'X' or 'Y'
  bool descending = false;
  std::int64_t length = 0;
};

std::optional<Axis> parse_axis(std::string_view& text) {
  const auto sign_and_name = next_word(text);
  const auto number = next_word(text);
  if (sign_and_name.size() != 2) return std::nullopt;
  Axis axis{sign_and_name[1], sign_and_name[0] == '-', 0};
  if (sign_and_name[0] != '-' && sign_and_name[0] != '+') return std::nullopt;
  if (axis.name != 'X' && axis.name != 'Y') return std::nullopt;
  const auto [end, code] =
      std::from_chars(number.data(), number.data() + number.size(), axis.length);
  if (code != std::errc{} || end != number.data() + number.size() || axis.length < 1) {
    return std::nullopt;
  }
  return axis;
}

// "-Y 512 +X 1024": the slow axis first. Y grows upwards and X to the right, so that -Y, +X are the
// directions in which pictures are looked at.
Status parse_resolution(std::string_view line, const std::string& path, RadianceHeader& header) {
  auto rest = line;
  const auto slow = parse_axis(rest);
  const auto fast = slow ? parse_axis(rest) : std::nullopt;
  if (!fast || !trimmed(rest).empty() || slow->name == fast->name) {
    return Error{
        ErrorCode::malformed,
        "has " + quoted(line) + " where the resolution should be, as in \"-Y 512 +X 1024\"", path,
        "the header is broken; write the file again"};
  }
  if (slow->length > kMaxSide || fast->length > kMaxSide ||
      slow->length * fast->length > kMaxPixels) {
    return Error{ErrorCode::unsupported,
                 fmt::format("declares {} scanlines of {} pixels; more than {} a side or {} in all "
                             "are not read",
                             slow->length, fast->length, kMaxSide, kMaxPixels),
                 path, "check whether the header is damaged"};
  }
  const auto against_view = [](const Axis& axis) { return axis.descending == (axis.name == 'X'); };
  header.scanline_count = static_cast<int>(slow->length);
  header.scanline_width = static_cast<int>(fast->length);
  header.scan_axis = slow->name == 'Y' ? ScanAxis::rows : ScanAxis::columns;
  header.scanlines_reversed = against_view(*slow);
  header.samples_reversed = against_view(*fast);
  return {};
}

// So that a few bytes cannot make anybody allocate, or wait for, a picture that is not there.
Status check_file_size(const RadianceHeader& header, const InputFile& file) {
  const std::uint64_t needed = static_cast<std::uint64_t>(header.scanline_count) *
                               smallest_radiance_scanline(header.scanline_width);
  const std::uint64_t present = file.size() - header.data_offset;
  if (present >= needed) return {};
  return Error{ErrorCode::malformed,
               fmt::format("declares {} scanlines of {} pixels, which take at least {} bytes, but "
                           "holds {} bytes of them",
                           header.scanline_count, header.scanline_width, needed, present),
               file.path(), "the file is cut off or its header damaged; copy it again"};
}

Error header_error(const InputFile& file, std::string what) {
  return Error{ErrorCode::malformed, std::move(what), file.path(),
               "check that this is a Radiance picture, copied as a whole"};
}

}  // namespace

bool looks_like_radiance(std::string_view first_bytes) {
  if (first_bytes.starts_with("#?")) return true;
  const auto key = first_bytes.find("FORMAT=32-bit_rle_");
  return key == 0 || (key != std::string_view::npos && first_bytes[key - 1] == '\n');
}

Result<RadianceHeader> read_radiance_header(const InputFile& file) {
  std::string text(std::min<std::uint64_t>(file.size(), kMaxHeaderBytes), '\0');
  SHOAL_ASSIGN_OR_RETURN(got, file.read_some(0, std::as_writable_bytes(std::span(text))));
  text.resize(got);
  if (!looks_like_radiance(std::string_view(text).substr(0, kRadianceSignatureBytes))) {
    return header_error(file, "does not start as a Radiance picture does, with \"#?\"");
  }

  RadianceHeader header;
  Variables variables;
  std::size_t begin = 0;
  for (bool in_resolution = false, any_variable = false;;) {
    const auto end = text.find('\n', begin);
    if (end == std::string::npos) {
      return header_error(file, "ends, or goes on for too long, within its header");
    }
    auto line = std::string_view(text).substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    begin = end + 1;
    if (in_resolution) {
      SHOAL_RETURN_IF_ERROR(parse_resolution(line, file.path(), header));
      break;
    }
    // Files of before 1991 may start with an empty line, where others have their signature.
    in_resolution = line.empty() && any_variable;
    any_variable = any_variable || !line.empty();
    SHOAL_RETURN_IF_ERROR(variables.take(line, file.path()));
  }
  header.data_offset = begin;
  variables.finish(header);
  SHOAL_RETURN_IF_ERROR(check_file_size(header, file));
  return header;
}

glm::dmat3 xyz_to_rec709() {
  // The inverse of the matrix that takes the three primaries of Rec.709 to XYZ, each scaled so that
  // they sum to its white (x, y) = (0.3127, 0.3290) with Y = 1. One line a column.
  return glm::dmat3(3.2409699419045213, -0.9692436362808798, 0.0556300796969936,   //
                    -1.5373831775700935, 1.8759675015077206, -0.2039769588889765,  //
                    -0.4986107602930033, 0.0415550574071756, 1.0569715142428784);
}

}  // namespace shoal
