// The two text forms of a coefficient table.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>

#include "output/table_formats.h"
#include "output/text_quoting.h"

namespace shoal {
namespace {

// Sign, 17 digits, point, "e-308".
constexpr std::size_t kMaxNumberLength = 25;

// fmt's 'g' is C's in the C locale, whatever the program's locale is.
void append_number(std::string& out, double value) {
  char digits[kMaxNumberLength];
  char* end = fmt::format_to(digits, FMT_COMPILE("{:.17g}"), value);
  out.append(digits, end);
}

void append_json_number(std::string& out, double value) {
  append_number(out, value);
  if (value == 0.0 && std::signbit(value)) out += ".0";
}

class CsvFormat : public TextFormat {
 public:
  explicit CsvFormat(VariantColumn variant) : variant_(variant) {}

  void begin(std::string& out) override {
    out += variant_ == VariantColumn::present ? "panorama,variant,quantity,l,m,r,g,b\n"
                                              : "panorama,quantity,l,m,r,g,b\n";
  }

  void record(std::string& out, const CoefficientRecord& record) override {
    std::string names = csv_quoted(record.panorama) + ',';
    if (variant_ == VariantColumn::present) names += csv_quoted(record.variant) + ',';
    names += name_of(record.quantity);
    for (int l = 0; l <= record.coefficients.degree; ++l) {
      for (int m = -l; m <= l; ++m) {
        out += names;
        fmt::format_to(std::back_inserter(out), FMT_COMPILE(",{},{}"), l, m);
        for (const auto& channel : record.coefficients.channels) {
          out += ',';
          append_number(out, channel[coefficient_index(l, m)]);
        }
        out += '\n';
      }
    }
  }

  void end(std::string&) override {}

 private:
  VariantColumn variant_;
};

class JsonFormat : public TextFormat {
 public:
  explicit JsonFormat(VariantColumn variant) : variant_(variant) {}

  void begin(std::string& out) override {
    out += R"({
"schema": "shoal/coefficients",
"version": 1,
"conventions": {
  "basis": "real, orthonormal over the unit sphere, without the Condon-Shortley phase",
  "index": "l*(l+1)+m, l = 0..degree, m = -l..l",
  "colour": "linear Rec.709",
  "channels": ["r", "g", "b"],
  "frame": "where the panorama's centre, right and up point",
)";
    out += "  \"quantities\": {\n";
    out += describe(Quantity::radiance) + "L_lm, the integral of L Y_lm over the sphere\",\n";
    out += describe(Quantity::irradiance) +
           "A_l L_lm with A_l of the clamped cosine: pi, 2pi/3, pi/4, 0, -pi/24, ...\",\n";
    out += describe(Quantity::irradiance_over_pi) + "A_l L_lm / pi\"\n  }\n},\n";
    out += "\"records\": [";
  }

  void record(std::string& out, const CoefficientRecord& record) override {
    out += count_++ == 0 ? "\n{" : ",\n{";
    append_name(out, "panorama", record.panorama);
    if (variant_ == VariantColumn::present) append_name(out, "variant", record.variant);
    fmt::format_to(std::back_inserter(out),
                   "\"quantity\": \"{}\", \"frame\": \"{}\", \"degree\": {}, ",
                   name_of(record.quantity), text_of(record.frame), record.coefficients.degree);
    out += "\"coefficients\": [";
    const auto& [red, green, blue] = record.coefficients.channels;
    for (std::size_t i = 0; i < red.size(); ++i) {
      out += i == 0 ? "[" : ", [";
      append_json_number(out, red[i]);
      out += ", ";
      append_json_number(out, green[i]);
      out += ", ";
      append_json_number(out, blue[i]);
      out += ']';
    }
    out += "]}";
  }

  void end(std::string& out) override { out += "\n]\n}\n"; }

 private:
  static std::string describe(Quantity quantity) {
    return fmt::format("    \"{}\": \"", name_of(quantity));
  }

  static void append_name(std::string& out, std::string_view key, std::string_view name) {
    fmt::format_to(std::back_inserter(out), "\"{}\": {}, ", key, json_quoted(name));
    if (is_utf8(name)) return;
    fmt::format_to(std::back_inserter(out), "\"{}_hex\": \"{}\", ", key, hexadecimal(name));
  }

  VariantColumn variant_;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<TextFormat> make_csv_format(VariantColumn variant) {
  return std::make_unique<CsvFormat>(variant);
}

std::unique_ptr<TextFormat> make_json_format(VariantColumn variant) {
  return std::make_unique<JsonFormat>(variant);
}

}  // namespace shoal
