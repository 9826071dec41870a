#include "bench/flying_edges.hpp"

#ifdef REAM_BENCH_VTK
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>

#include <chrono>

#endif

namespace ream::bench {

#ifdef REAM_BENCH_VTK

std::optional<FlyingEdgesRun> run_flying_edges(const std::array<int, 3>& dims,
                                               std::vector<uint8_t>& coverage_rows, bool normals,
                                               int threads) {
  vtkSMPTools::Initialize(threads);
  vtkNew<vtkUnsignedCharArray> values;
  values->SetArray(coverage_rows.data(), static_cast<vtkIdType>(coverage_rows.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(dims[0], dims[1], dims[2]);
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 127.5);
  filter->SetComputeNormals(normals);
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  return FlyingEdgesRun{taken.count(), static_cast<size_t>(filter->GetOutput()->GetNumberOfPolys())};
}

#else

std::optional<FlyingEdgesRun> run_flying_edges(const std::array<int, 3>&, std::vector<uint8_t>&, bool, int) {
  return std::nullopt;
}

#endif

}  // namespace ream::bench
