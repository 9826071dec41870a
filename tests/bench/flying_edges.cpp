#include "bench/flying_edges.hpp"

#ifdef REAM_BENCH_VTK
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>

#include "core/clock.hpp"
#endif

namespace ream::bench {

#ifdef REAM_BENCH_VTK

std::optional<FlyingEdgesRun> run_flying_edges(const voxel::VoxelGrid& grid,
                                               std::vector<uint8_t>& coverage_rows, bool normals,
                                               int threads) {
  vtkSMPTools::Initialize(threads);
  vtkNew<vtkUnsignedCharArray> values;
  values->SetArray(coverage_rows.data(), static_cast<vtkIdType>(coverage_rows.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.dims.x(), grid.dims.y(), grid.dims.z());
  image->SetSpacing(grid.spacing_mm.x(), grid.spacing_mm.y(), grid.spacing_mm.z());
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 127.5);
  filter->SetComputeNormals(normals);
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  const auto start = SteadyClock::now();
  filter->Update();
  return FlyingEdgesRun{elapsed_us(start) / 1000.0,
                        static_cast<size_t>(filter->GetOutput()->GetNumberOfPolys())};
}

#else

std::optional<FlyingEdgesRun> run_flying_edges(const voxel::VoxelGrid&, std::vector<uint8_t>&, bool, int) {
  return std::nullopt;
}

#endif

}  // namespace ream::bench
