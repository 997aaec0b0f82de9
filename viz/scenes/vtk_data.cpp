#include "scenes/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace shoal::viz {

vtkSmartPointer<vtkPolyData> to_poly_data(const Mesh& mesh) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->Allocate(static_cast<vtkIdType>(mesh.positions.size()));
  for (const glm::vec3& p : mesh.positions) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("normal");
  normals->SetNumberOfComponents(3);
  normals->Allocate(static_cast<vtkIdType>(3 * mesh.normals.size()));
  for (const glm::vec3& n : mesh.normals) normals->InsertNextTuple3(n.x, n.y, n.z);
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles->InsertNextCell({vtkIdType(a), vtkIdType(b), vtkIdType(c)});
  }
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetPointData()->SetNormals(normals);
  if (!mesh.values.empty()) {
    vtkNew<vtkFloatArray> values;
    values->SetName("value");
    values->Allocate(static_cast<vtkIdType>(mesh.values.size()));
    for (const float value : mesh.values) values->InsertNextValue(value);
    data->GetPointData()->AddArray(values);
  }
  return data;
}

void set_point_colours(vtkPolyData& data, std::span<const glm::vec3> colours) {
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("colour");
  bytes->SetNumberOfComponents(3);
  bytes->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  unsigned char* next = bytes->GetPointer(0);
  for (const glm::vec3& colour : colours) {
    for (int c = 0; c < 3; ++c) {
      *next++ = static_cast<unsigned char>(std::lround(255.0f * std::clamp(colour[c], 0.0f, 1.0f)));
    }
  }
  data.GetPointData()->SetScalars(bytes);
}

vtkSmartPointer<vtkPolyData> textured_poly_data(std::span<const TexturedPoint> points,
                                                std::span<const std::array<vtkIdType, 4>> faces) {
  vtkNew<vtkPoints> positions;
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  for (const auto& [position, place] : points) {
    positions->InsertNextPoint(position.x, position.y, position.z);
    places->InsertNextTuple2(place.x, place.y);
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& face : faces) cells->InsertNextCell(4, face.data());
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(positions);
  data->SetPolys(cells);
  data->GetPointData()->SetTCoords(places);
  return data;
}

vtkSmartPointer<vtkTexture> to_texture(const Picture& picture) {
  vtkNew<vtkImageData> image;
  const auto [width, height] = picture.size;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row_size = 3 * static_cast<std::size_t>(width);
  for (int row = 0; row < height; ++row) {  // a texture's rows start at the bottom
    std::copy_n(picture.rgb.data() + row_size * row, row_size,
                static_cast<unsigned char*>(image->GetScalarPointer(0, height - 1 - row, 0)));
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOff();
  texture->EdgeClampOn();
  texture->SetColorModeToDirectScalars();
  return texture;
}

}  // namespace shoal::viz
