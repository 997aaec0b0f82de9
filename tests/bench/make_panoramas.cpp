// Writes one made panorama into files of one or several kinds:
//   make_panoramas 4096x2048 [--seed N] hdr=a.hdr half-zip=a.exr
#include <ImfThreading.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <thread>

#include "bench/panorama_file.h"

namespace {

using shoal::bench::PanoramaFileRequest;

std::string kinds_text() {
  std::string text;
  for (const std::string& kind : shoal::bench::panorama_file_kinds()) text += " " + kind;
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a made panorama; kinds:" + kinds_text());
  std::string size;
  std::vector<std::string> outputs;
  std::uint64_t seed = 1;
  app.add_option("SIZE", size, "WIDTHxHEIGHT, at least 8x4")->required();
  app.add_option("KIND=FILE", outputs, "What to write, and where")->required();
  app.add_option("--seed", seed, "Another seed gives another picture");
  CLI11_PARSE(app, argc, argv);

  int width = 0;
  int height = 0;
  if (std::sscanf(size.c_str(), "%dx%d", &width, &height) != 2 || width < 8 || height < 4) {
    std::fprintf(stderr, "make_panoramas: \"%s\" is no size such as 4096x2048\n", size.c_str());
    return 2;
  }
  std::vector<PanoramaFileRequest> requests;
  for (const std::string& output : outputs) {
    const auto equals = output.find('=');
    if (equals == std::string::npos) {
      std::fprintf(stderr, "make_panoramas: \"%s\" is not KIND=FILE\n", output.c_str());
      return 2;
    }
    requests.push_back({output.substr(0, equals), output.substr(equals + 1)});
  }
  Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
  const shoal::Status made = shoal::bench::make_panorama_files(width, height, seed, requests);
  if (made) return 0;
  std::fprintf(stderr, "make_panoramas: %s\n", made.error().text().c_str());
  return 1;
}
