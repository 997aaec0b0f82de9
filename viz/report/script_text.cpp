#include "report/script_text.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "output/text_quoting.h"

namespace shoal::viz {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";         // U+FFFD
constexpr std::string_view kLineSeparator = "\xE2\x80\xA8";       // U+2028
constexpr std::string_view kParagraphSeparator = "\xE2\x80\xA9";  // U+2029

std::string_view html_entity(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

bool is_forbidden_in_html(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F;
}

}  // namespace

std::string script_quoted(std::string_view text) {
  const std::string json = json_quoted(text);
  std::string out;
  out.reserve(json.size());
  for (std::size_t i = 0; i < json.size();) {
    const std::string_view character = std::string_view(json).substr(i, utf8_length_at(json, i));
    if (character == "<" || character == ">" || character == "&") {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", character[0]);
    } else if (character == kLineSeparator) {
      out += "\\u2028";
    } else if (character == kParagraphSeparator) {
      out += "\\u2029";
    } else {
      out += character;
    }
    i += character.size();
  }
  return out;
}

std::string html_escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length_at(text, i);
    const std::string_view entity = html_entity(text[i]);
    if (length == 0 || is_forbidden_in_html(text[i])) {
      out += kReplacement;
    } else if (!entity.empty()) {
      out += entity;
    } else {
      out += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string exact_number(double value) {
  return std::isfinite(value) ? fmt::format(FMT_COMPILE("{:.17g}"), value) : "null";
}

std::string short_number(double value) {
  return std::isfinite(value) ? fmt::format(FMT_COMPILE("{:.6g}"), value) : "null";
}

std::string short_numbers(std::span<const double> values) {
  std::string out = "[";
  for (const double value : values) {
    if (out.size() > 1) out += ',';
    out += short_number(value);
  }
  return out + ']';
}

std::string exact_coefficients(const Coefficients& coefficients) {
  std::string out;
  for (std::size_t i = 0; i < coefficients.channels[0].size(); ++i) {
    for (const auto& channel : coefficients.channels) {
      if (!out.empty()) out += ' ';
      fmt::format_to(std::back_inserter(out), FMT_COMPILE("{:.17g}"), channel[i]);
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int k = 0; k < 4; ++k) {
      out += i + k > bytes.size() ? '=' : kAlphabet[group >> (18 - 6 * k) & 63u];
    }
  }
  return out;
}

}  // namespace shoal::viz
