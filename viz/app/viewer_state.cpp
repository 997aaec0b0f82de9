#include "app/viewer_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace shoal::viz {
namespace {

constexpr double kStop = 0.5;
constexpr double kMostStops = 30.0;
constexpr int kBasisDegree = 4;       // that its scene begins with
constexpr int kMostBasisDegree = 12;  // beyond it nobody could tell the lobes apart
constexpr int kChannels = 4;

// What is looked at in turn: pages of a contact sheet, panoramas of the rest, nothing of the basis.
KeyEffect step(const Library& library, int by, ViewerState& state) {
  if (state.scene == SceneKind::basis) return KeyEffect::nothing;
  if (state.scene == SceneKind::contact) {
    const int count = contact_page_count(library, state.settings);
    if (count == 1) return KeyEffect::nothing;
    state.settings.page = (state.settings.page + by + count) % count;
    state.panorama = static_cast<std::size_t>(state.settings.page) *
                     static_cast<std::size_t>(contact_cell_count(state.settings));
    return KeyEffect::show;
  }
  const std::size_t count = library.panoramas.size();
  state.panorama = (state.panorama + count + by) % count;
  return KeyEffect::show;
}

KeyEffect choose_scene(SceneKind scene, ViewerState& state) {
  if (scene == SceneKind::contact && state.scene != scene) {
    state.settings.page = static_cast<int>(state.panorama) / contact_cell_count(state.settings);
  }
  state.scene = scene;
  return KeyEffect::show;
}

// The highest degree that there is to see.
int highest_degree(const Library& library, const ViewerState& state) {
  if (state.scene == SceneKind::basis) {
    return std::max(kMostBasisDegree,
                    state.settings.degree.value_or(0));  // --degree may ask for more
  }
  if (state.scene != SceneKind::contact) {
    return library.panoramas[state.panorama].coefficients.degree;
  }
  int highest = 0;
  for (const Panorama& panorama : library.panoramas) {
    highest = std::max(highest, panorama.coefficients.degree);
  }
  return highest;
}

KeyEffect change_degree(const Library& library, int by, ViewerState& state) {
  const int highest = highest_degree(library, state);
  const int shown = shown_degree(library, state);
  const int degree = std::clamp(shown + by, 0, highest);
  state.settings.degree = degree;
  // All that there is, also of the next panorama, which may have more.
  if (degree == highest && state.scene != SceneKind::basis) state.settings.degree.reset();
  return degree == shown ? KeyEffect::tell_last_degree : KeyEffect::show;
}

KeyEffect change_exposure(double by, ViewerState& state) {
  double& stops = state.settings.exposure_stops;
  stops = std::clamp(stops + by, -kMostStops, kMostStops);
  return KeyEffect::show;
}

KeyEffect next_channel(ViewerState& state) {
  Channel& channel = state.settings.channel;
  channel = static_cast<Channel>((static_cast<int>(channel) + 1) % kChannels);
  return KeyEffect::show;
}

KeyEffect toggle_window(ViewerState& state) {
  state.window = state.window == DegreeWindow::none ? DegreeWindow::hann : DegreeWindow::none;
  return KeyEffect::show;
}

}  // namespace

KeyEffect press_key(char key, const Library& library, ViewerState& state) {
  if (key >= '1' && key < '1' + static_cast<char>(std::size(kAllScenes))) {
    return choose_scene(kAllScenes[key - '1'], state);
  }
  switch (key) {
    case 'n':
      return step(library, 1, state);
    case 'p':
      return step(library, -1, state);
    case '+':
    case '=':  // a plus without the shift key on many keyboards
      return change_degree(library, 1, state);
    case '-':
      return change_degree(library, -1, state);
    case 'w':
      return toggle_window(state);
    case 'e':
      return change_exposure(-kStop, state);
    case 'E':
      return change_exposure(kStop, state);
    case 'c':
      return next_channel(state);
    case 'r':
      return KeyEffect::reset_view;
    case 's':
      return KeyEffect::save;
    case 'h':
      return KeyEffect::toggle_help;
    case 'q':
      return KeyEffect::quit;
    default:
      return KeyEffect::nothing;
  }
}

int shown_degree(const Library& library, const ViewerState& state) {
  const int highest = highest_degree(library, state);
  const int whole = state.scene == SceneKind::basis ? kBasisDegree : highest;
  return std::min(state.settings.degree.value_or(whole), highest);
}

std::string last_degree_text(const Library& library, const ViewerState& state) {
  const int degree = shown_degree(library, state);
  const bool is_lowest = degree < highest_degree(library, state);
  if (is_lowest) return fmt::format("degree {} is the lowest", degree);
  return fmt::format(
      "degree {} is {}", degree,
      state.scene == SceneKind::basis ? "the highest that is drawn here" : "all there is");
}

std::string subject_name(const Library& library, const ViewerState& state) {
  const bool one = state.scene != SceneKind::basis && state.scene != SceneKind::contact;
  return one ? full_name(library.panoramas[state.panorama]) : library.title;
}

}  // namespace shoal::viz
