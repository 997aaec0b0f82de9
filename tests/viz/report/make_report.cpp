// Writes a report of made panoramas, and beside it what the page has to show.
//
//   make_report FOLDER COUNT DEGREE WIDTH [FRAME]
//
// FOLDER/index.html is the report. FOLDER/expected.json: {"basis": [{"direction", "values"}] to
// degree 64, "panoramas": [{"name", "csv": {quantity: what a table holds of it}}]}. The first names
// are hostile where COUNT is above 20.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iostream>

#include "made_library.h"
#include "output/coefficient_table.h"
#include "report/script_text.h"
#include "sphere/basis.h"

namespace {

namespace fs = std::filesystem;
using namespace shoal;
using namespace shoal::viz;

std::string csv_of(const Panorama& panorama, Quantity quantity, const Frame& frame) {
  std::string text;
  const auto sink = [&](std::string_view part) -> Status {
    text += part;
    return {};
  };
  auto table = stream_table(TableFormat::csv, sink, VariantColumn::present);
  const std::string variant(panorama.variant.empty() ? kPlainVariant : panorama.variant);
  const CoefficientRecord record{panorama.name, variant, quantity,
                                 apply_quantity(to_frame(panorama.coefficients, frame), quantity),
                                 frame};
  if (!(*table)->append(record) || !(*table)->commit()) std::abort();
  return text;
}

std::string exact_numbers(std::span<const double> values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "[" : ",") + exact_number(value);
  return out + "]";
}

std::string basis_values() {
  std::string out;
  for (const glm::dvec3 towards :
       {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0.3, -0.5, 0.8),
        glm::dvec3(-0.9, 0.2, -0.1), glm::dvec3(1e-3, 2e-3, 1)}) {
    const glm::dvec3 direction = glm::normalize(towards);
    std::vector<double> values(coefficient_count(kMaxDegree));
    Basis<double>(kMaxDegree).evaluate(direction, values);
    const std::array<double, 3> xyz = {direction.x, direction.y, direction.z};
    out += fmt::format("{}{{\"direction\":{},\"values\":{}}}", out.empty() ? "" : ",\n",
                       exact_numbers(xyz), exact_numbers(values));
  }
  return out;
}

std::string panorama_tables(const Library& library, const Frame& frame) {
  std::string out;
  for (const Panorama& panorama : library.panoramas) {
    std::string tables;
    for (const Quantity quantity :
         {Quantity::radiance, Quantity::irradiance, Quantity::irradiance_over_pi}) {
      tables += fmt::format("{}\"{}\":{}", tables.empty() ? "" : ",", name_of(quantity),
                            script_quoted(csv_of(panorama, quantity, frame)));
    }
    out += fmt::format("{}{{\"name\":{},\"csv\":{{{}}}}}", out.empty() ? "" : ",\n",
                       script_quoted(panorama.name), tables);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "usage: make_report FOLDER COUNT DEGREE WIDTH [FRAME]\n";
    return 2;
  }
  const fs::path folder = argv[1];
  Library library = viz::test::made_library(std::strtoul(argv[2], nullptr, 10), std::atoi(argv[3]));
  ReportSettings settings{folder, std::atoi(argv[4]), {}};
  if (argc > 5) settings.frame = *parse_frame(argv[5]);
  if (library.panoramas.size() > 20) {
    const std::vector<std::string> names = viz::test::hostile_names();
    for (std::size_t i = 0; i < names.size(); ++i) library.panoramas[i].name = names[i];
    library.panoramas[3].tags.push_back("<b>bold</b>");
    library.failed = {{"cut.exr", "row 17 ends after 203 of 1024 pixels"},
                      {names[0], "is no picture: " + names[1]}};
  }
  viz::test::MadePictures pictures;
  const bool bare = settings.thumbnail_width == 0;
  if (bare) settings.thumbnail_width = 512;
  const Status written =
      write_report(library, bare ? viz::test::no_pictures("it has no picture") : pictures.source(),
                   settings, {});
  if (!written) {
    std::cerr << written.error().text() << "\n";
    return 1;
  }
  std::ofstream(folder / "expected.json")
      << "{\"basis\":[" << basis_values() << "],\n\"panoramas\":["
      << panorama_tables(library, settings.frame.value_or(Frame{})) << "]}\n";
}
