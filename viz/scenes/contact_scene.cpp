#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "library/light.h"
#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/ball_picture.h"
#include "scenes/contact_card.h"
#include "scenes/equirect.h"
#include "scenes/legends.h"
#include "scenes/lobe.h"
#include "scenes/pictures.h"
#include "scenes/scene_parts.h"
#include "scenes/shared_camera.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr int kSumWidth = 256;  // of sums of the basis: two texels a half wave of degree 64
constexpr const char* kBetween = " · ";  // figures, on cards and in the caption
constexpr int kLobeRings = 24;
constexpr double kAxisLength = 0.97;  // its tip within the lobe that reaches 1 along it
constexpr int kBallDegree = 4;        // beyond it the clamped cosine leaves a few thousandths

// In the lower left corner of a picture; the brief one where there is room for no more.
void add_note(const std::string& full, const std::string& brief, Stage& stage,
              const Rectangle& place) {
  const double line = stage.line_height(TextSize::small);
  const double pad = 0.3 * line * stage.height() / stage.width();
  const bool fits = stage.text_width(full, TextSize::small) + 2.0 * pad <= place.width();
  const std::string& text = fits ? full : brief;
  const double width = stage.text_width(text, TextSize::small) + 2.0 * pad;
  stage.add_box({place.left, place.bottom, place.left + width, place.bottom + line}, theme::kPanel);
  stage.add_text(place.left + pad, place.bottom + 0.15 * line, text, {.size = TextSize::small});
}

// Of previews for thumbnails: about as many texels as pixels, of few sizes, which are kept.
int preview_width(const Stage& stage, const Rectangle& thumbnail) {
  const double pixels = thumbnail.width() * stage.width();
  return pixels <= 320.0 ? 256 : pixels <= 640.0 ? 512 : 1024;
}

// Whether pixels, where there are any, are not those of its light.
bool has_other_light(const Panorama& panorama) {
  const bool is_known = !panorama.file.empty() || !panorama.recipe.empty();
  return is_known && !panorama.change.is_whole;
}

// The pixels, or where there are none what is known of them.
void add_thumbnail(const SceneInput& input, std::size_t index, const Coefficients& radiance,
                   double exposure, Stage& stage, const Rectangle& place) {
  const Pixels& pixels = input.pixels->get(index, preview_width(stage, place));
  if (!pixels.empty()) {
    stage.add_picture(place, tone_mapped_picture(pixels, exposure));
    if (has_other_light(input.library->panoramas[index]))
      add_note("other light", "other", stage, place);
    return;
  }
  const Pixels sum = synthesise(radiance, kSumWidth, kSumWidth / 2);
  stage.add_picture(place, tone_mapped_picture(sum, exposure));
  add_note("no pixels: degree " + std::to_string(radiance.degree), "sum", stage, place);
}

std::string mean_text(const Coefficients& radiance) {
  return text_of(channel_of(mean_of(radiance), Channel::luminance));
}

std::string directed_text(const Coefficients& radiance) {
  const double dominance = std::min(1.0, dominance_of(radiance).value_or(0.0));
  return text_of(std::round(100.0 * dominance)) + " %";
}

// Name and figures, of which there are as many as have room: the name goes before them.
void add_words(const Panorama& panorama, const Coefficients& radiance, const ContactCard& card,
               Stage& stage) {
  const Rectangle& words = card.words;
  const double line = stage.line_height(TextSize::small);
  const auto fits = [&](const std::string& text) {
    return stage.text_width(text, TextSize::small) <= words.width();
  };
  const std::string name = title_of(panorama);
  const std::string mean = mean_text(radiance);
  const bool in_two_lines = card.lines > 2 && !panorama.variant.empty() && !fits(name);
  const TextStyle style{
      .size = TextSize::small, .max_width = words.width(), .cut = TextCut::middle};
  stage.add_text(words.left, words.top - 0.9 * line, in_two_lines ? panorama.name : name, style);
  if (in_two_lines) {
    stage.add_text(words.left, words.top - 1.9 * line, "(" + panorama.variant + ")", style);
  }
  TextStyle figures{.size = TextSize::small, .colour = theme::kDimText};
  if (card.lines == 1) {
    figures.align = TextAlign::right;
    if (fits(name + "  " + mean)) {
      stage.add_text(words.right, words.top - 0.9 * line, mean, figures);
    }
    return;
  }
  const std::string both = mean + kBetween + directed_text(radiance);
  const double second = words.top - 1.9 * line;
  if (fits(mean)) {
    stage.add_text(words.left, in_two_lines ? second - line : second, fits(both) ? both : mean,
                   figures);
  }
}

void add_lobe(const SceneInput& input, const Panorama& panorama, SharedCamera& camera, Stage& stage,
              const Rectangle& place) {
  vtkRenderer& view = stage.add_view(place);
  camera.look(view, input.settings.frame, 1.0);
  const Lobe lobe = make_lobe(panorama, input.settings, kLobeRings);
  add_small_axes(view, kAxisLength);
  add_mesh(view, lobe.mesh, lobe.colours, Shading::lit);
}

void add_card(const SceneInput& input, std::size_t index, SharedCamera& camera, Stage& stage,
              const Rectangle& cell) {
  const Panorama& panorama = input.library->panoramas[index];
  const Coefficients radiance = radiance_of(panorama);
  const double exposure = automatic_exposure(radiance, input.settings.exposure_stops);
  const ContactCard card = lay_out_card(stage, cell);
  stage.add_panel(cell);
  add_thumbnail(input, index, radiance, exposure, stage, card.thumbnail);
  const int side = std::max(16, static_cast<int>(std::lround(card.ball.height() * stage.height())));
  const Coefficients light =
      apply_quantity(truncate(radiance, kBallDegree), Quantity::irradiance_over_pi);
  stage.add_picture(card.ball,
                    ball_picture(light, input.settings.frame, exposure, side, theme::kPanel));
  add_lobe(input, panorama, camera, stage, card.lobe);
  add_words(panorama, radiance, card, stage);
}

// The panoramas of the page. Error: usage, for one that does not exist.
Result<std::vector<std::size_t>> panoramas_of_page(const Library& library,
                                                   const SceneSettings& settings) {
  const int pages = contact_page_count(library, settings);
  if (settings.page < 0 || settings.page >= pages) {
    return Error{ErrorCode::usage,
                 "the contact sheet has no page " + std::to_string(settings.page + 1), "",
                 "it has " + std::to_string(pages) + (pages == 1 ? " page" : " pages")};
  }
  const auto cells = static_cast<std::size_t>(contact_cell_count(settings));
  std::vector<std::size_t> shown;
  for (std::size_t i = cells * settings.page;
       i < std::min(cells * (settings.page + 1), library.panoramas.size()); ++i) {
    shown.push_back(i);
  }
  return shown;
}

void add_cards(const SceneInput& input, const std::vector<std::size_t>& shown, Stage& stage) {
  const double gap = 2.0 / 720.0;
  const double gap_width = gap * stage.height() / stage.width();
  const Rectangle area = inset(stage.body(), -gap_width, 0.0);  // outer cards end with the title
  // That of a whole page also on the last one, which may have fewer.
  const auto count = static_cast<int>(input.library->panoramas.size());
  const Grid grid =
      input.settings.grid.value_or(roomiest_grid(stage, area, std::min(count, kCellsOfPage)));
  const auto cell = [&](std::size_t i) {
    const auto place = static_cast<int>(i);
    return inset(
        grid_cell(area, grid.columns, grid.rows, place % grid.columns, place / grid.columns),
        gap_width, gap);
  };
  input.pixels->prepare(shown, preview_width(stage, lay_out_card(stage, cell(0)).thumbnail));
  SharedCamera camera;
  for (std::size_t i = 0; i < shown.size(); ++i) add_card(input, shown[i], camera, stage, cell(i));
}

std::string subject_of(const Library& library, const SceneSettings& settings) {
  std::string subject = count_text(library);
  const int pages = contact_page_count(library, settings);
  if (pages > 1) {
    subject += ", page " + std::to_string(settings.page + 1) + " of " + std::to_string(pages);
  }
  return subject;
}

}  // namespace

int contact_cell_count(const SceneSettings& settings) {
  return settings.grid ? settings.grid->columns * settings.grid->rows : kCellsOfPage;
}

int contact_page_count(const Library& library, const SceneSettings& settings) {
  const int cells = contact_cell_count(settings);
  return std::max(1, (static_cast<int>(library.panoramas.size()) + cells - 1) / cells);
}

Status show_contact_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  SHOAL_ASSIGN_OR_RETURN(shown, panoramas_of_page(*input.library, settings));

  stage.set_title(input.library->title, subject_of(*input.library, settings));
  const bool some_changed = std::ranges::any_of(
      shown, [&](std::size_t i) { return has_other_light(input.library->panoramas[i]); });
  const bool is_dense = contact_cell_count(settings) > kCellsOfPage;
  const std::string lines[] = {
      "each at its own exposure: pixels, irradiance on a white ball, " +
          describe(settings.quantity) + " lobes of " + std::string(name_of(settings.channel)) +
          " at a scale of their own" +
          (some_changed ? "; other light: pixels before lights were added "
                          "or a part taken out"
                        : ""),
      std::string(is_dense ? "where there is room: " : "") + "mean luminance" + kBetween +
          "how far the light comes from one side; " + describe(settings.frame)};
  stage.set_caption(lines);
  add_cards(input, shown, stage);
  return {};
}

}  // namespace shoal::viz
