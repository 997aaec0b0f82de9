// OpenImageIO's pixels through libsharp, the transform library of cosmology. Source: Reinecke &
// Seljebotn, "Libsharp - spherical harmonic transforms revisited", A&A 554 (2013), A112.
#include <libsharp/sharp.h>
#include <libsharp/sharp_almhelpers.h>
#include <libsharp/sharp_geomhelpers.h>

#include <algorithm>
#include <atomic>
#include <complex>
#include <memory>
#include <mutex>
#include <numbers>
#include <thread>

#include "bench/oiio_picture.h"
#include "bench/yardstick.h"

namespace shoal::bench {
namespace {

constexpr int kColourChannels = 3;

struct DestroyGeometry {
  void operator()(sharp_geom_info* geometry) const { sharp_destroy_geom_info(geometry); }
};
struct DestroyHarmonics {
  void operator()(sharp_alm_info* harmonics) const { sharp_destroy_alm_info(harmonics); }
};

// What one thread keeps from file to file.
class Analyst {
 public:
  explicit Analyst(int degree) {
    sharp_alm_info* harmonics = nullptr;
    sharp_make_triangular_alm_info(degree, degree, 1, &harmonics);
    harmonics_.reset(harmonics);
    coefficients_.resize(sharp_alm_count(harmonics));
  }

  Status analyse_file(const std::string& path) {
    SHOAL_RETURN_IF_ERROR(read_with_oiio(path, picture_));
    if (!geometry_ || width_ != picture_.width || height_ != picture_.height) make_geometry();
    for (int c = 0; c < std::min(kColourChannels, picture_.channel_count); ++c) {
      void* map = picture_.samples.get() + c;
      void* coefficients = coefficients_.data();
      sharp_execute(SHARP_MAP2ALM, 0, &coefficients, &map, geometry_.get(), harmonics_.get(), 0,
                    nullptr, nullptr);
    }
    return {};
  }

 private:
  // Fejer's rule on the pixel centres; the stride steps over the other channels.
  void make_geometry() {
    width_ = picture_.width;
    height_ = picture_.height;
    const int stride = picture_.channel_count;
    sharp_geom_info* geometry = nullptr;
    sharp_make_fejer1_geom_info(height_, width_, std::numbers::pi / width_, stride, stride * width_,
                                &geometry);
    geometry_.reset(geometry);
  }

  int width_ = 0;
  int height_ = 0;
  OiioPicture picture_;
  std::unique_ptr<sharp_geom_info, DestroyGeometry> geometry_;
  std::unique_ptr<sharp_alm_info, DestroyHarmonics> harmonics_;
  std::vector<std::complex<float>> coefficients_;
};

Status analyse_all(const std::vector<std::string>& files, std::vector<Analyst>& analysts) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  Status status;
  {
    std::vector<std::jthread> threads;
    for (Analyst& analyst : analysts) {
      threads.emplace_back([&] {
        for (std::size_t i = next++; i < files.size(); i = next++) {
          Status done = analyst.analyse_file(files[i]);
          const std::scoped_lock lock(mutex);
          if (!done) status = std::move(done);
        }
      });
    }
  }
  return status;
}

}  // namespace

Seconds time_libsharp(const YardstickWork& work) {
  set_oiio_threads(1);
  std::vector<Analyst> analysts;
  for (int i = 0; i < work.threads; ++i) analysts.emplace_back(work.degree);
  return repeated(work.repeat, [&] { return analyse_all(work.files, analysts); });
}

}  // namespace shoal::bench
