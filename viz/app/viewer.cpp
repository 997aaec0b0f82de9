#include "app/viewer.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/hann_window.h"
#include "app/messages.h"
#include "app/turned_cameras.h"
#include "app/viewer_pages.h"
#include "app/viewer_state.h"
#include "app/viewer_style.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

enum class Cameras { keep, reset };

// NAME.SCENE.png in the working folder, or with a number where there is such a picture: none that
// somebody saved is lost. Told in full, since nobody sees in a window where it was opened.
std::filesystem::path free_file(const Library& library, const ViewerState& state) {
  std::string name = subject_name(library, state);
  for (char& c : name) {
    if (c == '/') c = '_';
  }
  const std::string stem = fmt::format("{}.{}", name, name_of(state.scene));
  std::filesystem::path file = stem + ".png";
  std::error_code code;
  for (int number = 2; std::filesystem::exists(file, code); ++number) {
    file = fmt::format("{}-{}.png", stem, number);
  }
  const auto full = std::filesystem::absolute(file, code);
  return code ? file : full;
}

class Viewer {
 public:
  Viewer(const Library& library, PixelCache& pixels, const ViewerStart& start)
      : library_(library),
        pixels_(pixels),
        other_(start.other),
        state_{start.scene, start.panorama, start.settings} {
    window_->SetSize(start.size.width, start.size.height);
    window_->SetMultiSamples(kSampleCount);
    window_->SetDPI(72);  // a point of type is a pixel, whatever the monitor
    style_->on_key = [this](char key) { press(key); };
    interactor_->SetInteractorStyle(style_);
    interactor_->SetRenderWindow(window_);
    resized_->SetClientData(this);
    resized_->SetCallback([](vtkObject*, unsigned long, void* viewer, void*) {
      static_cast<Viewer*>(viewer)->follow_size();
    });
    interactor_->AddObserver(vtkCommand::ConfigureEvent, resized_);
  }

  void run() {
    show(Cameras::reset);
    interactor_->Initialize();
    follow_size();  // the window manager may have given another
    interactor_->Start();
  }

 private:
  void press(char key) {
    take_notice_away();
    switch (press_key(key, library_, state_)) {
      case KeyEffect::nothing:
        return;
      case KeyEffect::show:
        return show(Cameras::keep);
      case KeyEffect::reset_view:
        return show(Cameras::reset);
      case KeyEffect::toggle_help:
        return toggle_help();
      case KeyEffect::tell_last_degree:
        return give_notice(last_degree_text(library_, state_));
      case KeyEffect::save:
        return save();
      case KeyEffect::quit:
        return interactor_->TerminateApp();
    }
  }

  void show(Cameras cameras) {
    style_->stop();
    fill();
    // Another scene's views are others.
    if (cameras == Cameras::keep && shown_scene_ == state_.scene) {
      cameras_.carry_over_to(*window_);
    } else {
      cameras_.note(*window_);
    }
    shown_scene_ = state_.scene;
    shown_size_ = size();
    if (help_) help_.emplace(show_help(*window_));
    notice_.reset();
    const std::string name = subject_name(library_, state_);
    window_->SetWindowName(fmt::format("shoal - {} - {}", name, name_of(state_.scene)).c_str());
    window_->Render();
  }

  void fill() {
    SceneInput input{&library_, state_.panorama, other_, state_.settings, &pixels_};
    if (state_.window == DegreeWindow::hann) {
      windowed_ = hann_windowed(library_, seen_panoramas(), state_.settings.degree);
      input.library = &windowed_;
    }
    Status shown = show_scene(state_.scene, input, *window_);
    if (shown) return;
    Error error = shown.error();
    error.hint.clear();  // it speaks of options; here other keys are what to try
    show_failure(subject_name(library_, state_), std::string(name_of(state_.scene)), error,
                 *window_);
  }

  [[nodiscard]] std::vector<std::size_t> seen_panoramas() const {
    if (state_.scene == SceneKind::compare && other_) return {state_.panorama, *other_};
    if (state_.scene != SceneKind::contact) return {state_.panorama};
    std::vector<std::size_t> all(library_.panoramas.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }

  [[nodiscard]] PictureSize size() const {
    const int* size = window_->GetSize();
    return {size[0], size[1]};
  }

  void follow_size() {
    if (size() != shown_size_) show(Cameras::keep);
  }

  void toggle_help() {
    if (help_) {
      help_->take_away();
      help_.reset();
    } else {
      help_.emplace(show_help(*window_));
    }
    window_->Render();
  }

  void give_notice(const std::string& text) {
    notice_.emplace(show_notice(text, *window_));
    window_->Render();
  }

  void take_notice_away() {
    if (!notice_) return;
    notice_->take_away();
    notice_.reset();
    window_->Render();
  }

  // Of the scene alone, without the help.
  void save() {
    const auto file = free_file(library_, state_);
    if (help_) help_->take_away();
    Status written = write_png(take_picture(*window_), file);
    if (!written) written.error().hint = "start `shoal view` in another folder";
    if (help_) help_.emplace(show_help(*window_));
    const std::string said = written ? "saved " + file.string() : written.error().text();
    give_notice(said);
    if (written) {
      tell(said);
    } else {
      report_error(written.error());
    }
  }

  const Library& library_;
  PixelCache& pixels_;
  std::optional<std::size_t> other_;
  ViewerState state_;
  Library windowed_;
  TurnedCameras cameras_;
  SceneKind shown_scene_ = SceneKind::basis;
  PictureSize shown_size_;
  std::optional<Stage> help_;
  std::optional<Stage> notice_;  // until the next key
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<ViewerStyle> style_;
  vtkNew<vtkCallbackCommand> resized_;
};

}  // namespace

void run_viewer(const Library& library, PixelCache& pixels, const ViewerStart& start) {
  Viewer(library, pixels, start).run();
}

}  // namespace shoal::viz
