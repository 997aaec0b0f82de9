#include "scenes/lobe_export.h"

#include <vtkNew.h>
#include <vtkXMLPolyDataWriter.h>

#include <string>

#include "core/atomic_file.h"
#include "scenes/gltf.h"
#include "scenes/lobe.h"
#include "scenes/scene_parts.h"
#include "scenes/vtk_data.h"

namespace shoal::viz {
namespace {

Status write_vtp(const Lobe& lobe, const std::filesystem::path& path) {
  const auto data = to_poly_data(lobe.mesh);
  set_point_colours(*data, lobe.colours);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->WriteToOutputStringOn();
  if (!writer->Write()) {
    return Error{ErrorCode::write_failed, "VTK cannot write this mesh", path.string(), ""};
  }
  return write_file_atomically(path, writer->GetOutputString());
}

GltfNotes notes_of(const SceneInput& input, const Lobe& lobe) {
  const SceneSettings& settings = input.settings;
  return {
      {"panorama", title_of(current_panorama(input))},
      {"quantity", std::string(name_of(settings.quantity))},
      {"channel", std::string(name_of(settings.channel))},
      {"degree", std::to_string(lobe.degree)},
      {"frame", shoal::text_of(settings.frame)},
      {"radius", "1 stands for " + std::to_string(lobe.unit)},
      {"orientation",
       "points are in the frame's x, y, z (centre, right, up of the panorama as in \"frame\"); "
       "the node turns up to +y and centre to +z"},
  };
}

}  // namespace

Status write_lobes(const SceneInput& input, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".vtp" && extension != ".glb" && extension != ".gltf") {
    return Error{ErrorCode::usage, "lobes cannot be written as \"" + extension + '"', path.string(),
                 "name a file that ends in .vtp, .gltf or .glb"};
  }
  const Lobe lobe = make_lobe(current_panorama(input), input.settings, kFineRings);
  if (extension == ".vtp") return write_vtp(lobe, path);
  const GltfModel model{lobe.mesh, lobe.colours, input.settings.frame, notes_of(input, lobe)};
  return write_file_atomically(path, extension == ".glb" ? glb_text(model) : gltf_text(model));
}

}  // namespace shoal::viz
