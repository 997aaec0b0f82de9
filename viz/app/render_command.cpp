#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <optional>
#include <utility>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/messages.h"
#include "app/output_names.h"
#include "app/scene_options.h"
#include "library/pixels.h"
#include "scenes/lobe_export.h"
#include "scenes/scene.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

struct RenderCommand {
  LibraryOptions library;
  SceneOptions scene;
  std::string output;
  std::string format;
  std::string page = "all";
  std::string way = "auto";
};

// One picture: what it shows, and its file.
struct Shot {
  SceneInput input;
  std::filesystem::path file;
};

OffscreenWay way_of(const std::string& name) {
  if (name == "surfaceless") return OffscreenWay::surfaceless;
  return name == "x" ? OffscreenWay::x_display : OffscreenWay::automatic;
}

// The pages asked for, from 0. Error: usage.
Result<std::vector<int>> pages_of(const std::string& page, int count) {
  std::vector<int> pages;
  if (page == "all") {
    for (int i = 0; i < count; ++i) pages.push_back(i);
    return pages;
  }
  int number = 0;
  const auto parsed = std::from_chars(page.data(), page.data() + page.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != page.data() + page.size() || number < 1 ||
      number > count) {
    return Error{ErrorCode::usage, fmt::format("--page {} is none of the {} pages", page, count),
                 "", "1 is the first, and all are all"};
  }
  return std::vector<int>{number - 1};
}

class Renderer {
 public:
  Renderer(const RenderCommand& command, const SceneChoice& choice, OutputFormat format,
           Library library)
      : command_(command),
        choice_(choice),
        format_(format),
        library_(std::move(library)),
        pixels_(library_) {}

  Status run() {
    SHOAL_ASSIGN_OR_RETURN(shots, choose_shots());
    return format_ == OutputFormat::png ? take(shots) : write_meshes(shots);
  }

 private:
  [[nodiscard]] SceneInput input() {
    SceneInput input;
    input.library = &library_;
    input.settings = choice_.settings;
    input.pixels = &pixels_;
    return input;
  }

  Result<std::vector<Shot>> choose_shots() {
    if (choice_.scene == SceneKind::contact) return contact_shots();
    if (choice_.scene == SceneKind::basis) return basis_shot();
    return panorama_shots();
  }

  Result<std::vector<Shot>> basis_shot() {
    SHOAL_ASSIGN_OR_RETURN(files, output_files(command_.output, format_, "{name}", {"basis"}));
    return std::vector<Shot>{{input(), files.front()}};
  }

  Result<std::vector<Shot>> panorama_shots() {
    SHOAL_ASSIGN_OR_RETURN(selected, select(library_, command_.library.panorama));
    SHOAL_ASSIGN_OR_RETURN(other, select_other(library_, command_.scene.with));
    std::vector<std::string> names;
    for (const std::size_t panorama : selected) {
      names.push_back(full_name(library_.panoramas[panorama]));
    }
    SHOAL_ASSIGN_OR_RETURN(files, output_files(command_.output, format_, "{name}", names));
    pixels_.expect(selected);
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < selected.size(); ++i) {
      Shot& shot = shots.emplace_back(Shot{input(), files[i]});
      shot.input.current = selected[i];
      shot.input.other = other;
    }
    return shots;
  }

  Result<std::vector<Shot>> contact_shots() {
    const int count = contact_page_count(library_, choice_.settings);
    SHOAL_ASSIGN_OR_RETURN(pages, pages_of(command_.page, count));
    std::vector<std::string> names;
    for (const int page : pages) names.push_back(fmt::format("{:03}", page + 1));
    SHOAL_ASSIGN_OR_RETURN(files, output_files(command_.output, format_, "{page}", names));
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < library_.panoramas.size(); ++i) all.push_back(i);
    pixels_.expect(std::move(all));
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < pages.size(); ++i) {
      shots.push_back({input(), files[i]});
      shots.back().input.settings.page = pages[i];
    }
    return shots;
  }

  Status take(const std::vector<Shot>& shots) {
    SHOAL_ASSIGN_OR_RETURN(window, make_offscreen_window(choice_.size, way_of(command_.way)));
    Progress progress("rendering");
    for (std::size_t i = 0; i < shots.size(); ++i) {
      progress.show(i, shots.size());
      Status done = show_scene(choice_.scene, shots[i].input, *window);
      if (done) done = write_png(take_picture(*window), shots[i].file);
      SHOAL_RETURN_IF_ERROR(note(std::move(done), shots, i));
    }
    return {};
  }

  Status write_meshes(const std::vector<Shot>& shots) {
    Progress progress("writing");
    for (std::size_t i = 0; i < shots.size(); ++i) {
      progress.show(i, shots.size());
      SHOAL_RETURN_IF_ERROR(note(write_lobes(shots[i].input, shots[i].file), shots, i));
    }
    return {};
  }

  // One of several that cannot be drawn is told, and the others are drawn.
  Status note(Status done, const std::vector<Shot>& shots, std::size_t shot) {
    if (done) {
      written_.push_back(shots[shot].file);
      return {};
    }
    // Where one cannot be written none can.
    const bool is_last = shots.size() == 1 || done.error().code == ErrorCode::write_failed;
    if (is_last) return done;
    report_error(done.error());
    ++failed_count_;
    return {};
  }

  const RenderCommand& command_;
  const SceneChoice& choice_;
  OutputFormat format_;
  Library library_;
  PixelCache pixels_;
  std::vector<std::filesystem::path> written_;
  int failed_count_ = 0;  // of several

 public:
  [[nodiscard]] int failed_count() const { return failed_count_; }
  [[nodiscard]] const std::vector<std::filesystem::path>& written() const { return written_; }
};

// The library, or nothing for a scene that needs none. A contact sheet shows all that there is.
Result<Library> library_for(const RenderCommand& command, SceneKind scene) {
  if (!command.library.sources.empty()) {
    return scene == SceneKind::contact ? load_selected(command.library) : load(command.library);
  }
  if (scene == SceneKind::basis) return Library();
  return Error{ErrorCode::usage, "OUT is missing", "",
               "name an output folder of `shoal run`, a table or panoramas"};
}

int render(const CLI::App& app, const RenderCommand& command) {
  auto choice = understand(command.scene, command.library.degree);
  if (!choice) return report_error(choice.error());
  if (const Status effect = expect_effect(app, choice->scene); !effect) {
    return report_error(effect.error());
  }
  if (command.output.empty()) {
    return report_error({ErrorCode::usage, "-o is missing", "",
                         "-o FILE.png names the picture, -o DIR/ a folder for one of each"});
  }
  const auto format = output_format(command.output, command.format);
  if (!format) return report_error(format.error());
  if (*format != OutputFormat::png && choice->scene != SceneKind::lobes) {
    return report_error({ErrorCode::usage, "only the scene lobes can be written as a mesh",
                         command.output, "a picture ends in .png"});
  }
  auto library = library_for(command, choice->scene);
  if (!library) return report_error(library.error());
  if (command.scene.frame.empty()) choice->settings.frame = frame_of(*library);
  Renderer renderer(command, *choice, *format, std::move(*library));
  const Status done = renderer.run();
  for (const auto& file : renderer.written()) fmt::print("{}\n", file.string());
  if (!done) return report_error(done.error());
  return renderer.failed_count() == 0 ? kExitOk : kExitFailed;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("render", "Make a picture of a library's lighting; needs no display");
  auto options = std::make_shared<RenderCommand>();
  add_library_options(*command, options->library, Sources::optional);
  add_scene_options(*command, options->scene);
  command->add_option("--page", options->page,
                      scene_help("--page", "A page from 1, or all (the default)"));
  command->add_option(
      "-o,--output", options->output,
      "FILE.png, or FILE.vtp, .gltf or .glb for a mesh of the lobes; DIR/, or {name} "
      "or {page} in the file's name, where there are several");
  command->add_option("--format", options->format, "png, vtp, gltf or glb, where -o is a folder")
      ->check(CLI::IsMember({"png", "vtp", "gltf", "glb"}));
  command->add_option("--way", options->way, "auto, surfaceless or x")
      ->check(CLI::IsMember({"auto", "surfaceless", "x"}))
      ->group("");  // for tests
  command->callback([&action, command, options] {
    action = [command, options] { return render(*command, *options); };
  });
}

}  // namespace shoal::viz
