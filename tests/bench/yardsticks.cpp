// Times in this process, start-up left out, one line of seconds a repetition:
//   yardsticks oiio|libsharp|inflate|shoal FILE... [--repeat K] [-j N] [--degree L]
//   yardsticks versions
#include <OpenEXRConfig.h>
#include <libdeflate.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>

#include "bench/yardstick.h"

namespace {

using shoal::bench::Seconds;
using shoal::bench::YardstickWork;

struct Yardstick {
  const char* name;
  const char* what;
  Seconds (*time)(const YardstickWork&);
};

constexpr Yardstick kYardsticks[] = {
    {"oiio", "OpenImageIO reads each file to floats; -j: its own threads", shoal::bench::time_oiio},
    {"libsharp", "OpenImageIO reads, libsharp analyses; -j: files at once",
     shoal::bench::time_libsharp},
    {"inflate", "libdeflate inflates the ZIP chunks, read ahead", shoal::bench::time_inflate},
    {"shoal", "shoal projects", shoal::bench::time_shoal},
};

int run(const Yardstick& yardstick, const YardstickWork& work) {
  const Seconds seconds = yardstick.time(work);
  if (!seconds) {
    std::fprintf(stderr, "yardsticks: %s\n", seconds.error().text().c_str());
    return 1;
  }
  for (const double value : *seconds) std::printf("%.6f\n", value);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times what shoal is measured against");
  app.require_subcommand(1);
  YardstickWork work;
  std::function<int()> action;
  for (const Yardstick& yardstick : kYardsticks) {
    CLI::App* command = app.add_subcommand(yardstick.name, yardstick.what);
    command->add_option("FILE", work.files, "Panoramas")->required();
    command->add_option("--repeat", work.repeat, "Timed repetitions after one untimed");
    command->add_option("-j,--threads", work.threads, "Threads")->check(CLI::PositiveNumber);
    command->add_option("--degree", work.degree, "Highest degree (libsharp, shoal)");
    command->add_flag_callback(
        "--reuse-buffer", [&work] { work.buffer = shoal::bench::SampleBuffer::reused; },
        "Into the pages of the file before (oiio)");
    command->callback(
        [&action, &work, &yardstick] { action = [&] { return run(yardstick, work); }; });
  }
  app.add_subcommand("versions", "Of the libraries measured against")->callback([&action] {
    action = [] {
      std::printf("OpenImageIO %s, OpenEXR %s, libdeflate %s\n",
                  shoal::bench::oiio_version().c_str(), OPENEXR_VERSION_STRING,
                  LIBDEFLATE_VERSION_STRING);
      return 0;
    };
  });
  CLI11_PARSE(app, argc, argv);
  return action();
}
