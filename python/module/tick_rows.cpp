#include "module/tick_rows.hpp"

#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>

#include "core/error.hpp"
#include "geometry/pose.hpp"
#include "module/computing.hpp"
#include "record/trace_columns.hpp"
#include "record/trace_csv.hpp"

namespace ream::python {
namespace {

namespace py = pybind11;
using record::ops::Tick;

static_assert(std::is_trivially_copyable_v<Tick> && std::is_standard_layout_v<Tick>);

py::dtype dtype_of(const QuantisedPose&) {
  py::list names, formats, offsets;
  names.append("rotation_q30");
  formats.append("9i4");
  offsets.append(offsetof(QuantisedPose, rotation_q30));
  names.append("translation_nm");
  formats.append("3i4");
  offsets.append(offsetof(QuantisedPose, translation_nm));
  return py::dtype(names, formats, offsets, sizeof(QuantisedPose));
}
template <typename Number>
py::dtype dtype_of(const Number&) {
  return py::dtype::of<Number>();
}

/// Lives as long as the interpreter. Not a static of a function: making it runs Python, which may hand over
/// to a thread that would then wait for it with the interpreter's lock.
PyObject* tick_type = nullptr;

/// Takes a row's values into arrays, one after the other.
class ColumnWriter {
 public:
  explicit ColumnWriter(std::vector<double*> columns) : columns_(std::move(columns)) {}

  void begin(size_t row) { row_ = row, column_ = 0; }
  ColumnWriter& add(double value) {
    columns_.at(column_++)[row_] = value;
    return *this;
  }
  ColumnWriter& add(int64_t value) { return add(static_cast<double>(value)); }
  ColumnWriter& add(const Vec3& v) { return add(v.x()).add(v.y()).add(v.z()); }
  ColumnWriter& add(const Pose& pose) {
    add(pose.translation_mm);
    for (const double q : quaternion_from_rotation(pose.rotation)) add(q);
    return *this;
  }

 private:
  std::vector<double*> columns_;
  size_t row_ = 0, column_ = 0;
};

}  // namespace

py::dtype make_tick_dtype() {
  py::list names, formats, offsets;
  const Tick row;
  size_t at = 0;
  Tick::visit_fields(row, [&](const auto& field, uint32_t) {
    names.append(std::string(Tick::field_names[at++]));
    formats.append(dtype_of(field));
    offsets.append(reinterpret_cast<const char*>(&field) - reinterpret_cast<const char*>(&row));
  });
  py::dtype made(names, formats, offsets, sizeof(Tick));
  tick_type = py::dtype(made).release().ptr();
  return made;
}

py::array tick_array(std::vector<Tick> rows) {
  auto kept = std::make_unique<std::vector<Tick>>(std::move(rows));
  const auto count = static_cast<py::ssize_t>(kept->size());
  const void* data = kept->data();
  const py::capsule owner(kept.release(), [](void* p) { delete static_cast<std::vector<Tick>*>(p); });
  return py::array(py::reinterpret_borrow<py::dtype>(tick_type), {count},
                   {static_cast<py::ssize_t>(sizeof(Tick))}, data, owner);
}

py::dict trace_arrays(const std::vector<Tick>& rows, const voxel::VoxelGrid& grid,
                      const Pose& world_from_plan, int64_t removed) {
  py::dict table;
  std::vector<double*> columns;
  for (const record::TraceColumn& column : record::trace_columns()) {
    py::array_t<double> values(static_cast<py::ssize_t>(rows.size()));
    columns.push_back(values.mutable_data());
    table[std::string(column.name).c_str()] = values;
  }
  const PlainNumbers plain;
  record::TraceValues values(grid.voxel_volume_mm3(), world_from_plan.inverse());
  record::TickReport before;
  before.coverage_removed[0] = removed;
  values.pass(before);
  ColumnWriter writer(std::move(columns));
  for (size_t row = 0; row < rows.size(); ++row) {
    writer.begin(row);
    values.add(record::report_of(rows[row], grid.world_from_grid), writer);
  }
  return table;
}

std::vector<Tick> ticks_from(const py::array& rows) {
  if (rows.ndim() != 1 || !rows.dtype().equal(py::reinterpret_borrow<py::dtype>(tick_type)))
    throw Error(ErrorKind::invalid_input, "ticks must be a list of rows of type ream.TICK");
  std::vector<Tick> ticks(static_cast<size_t>(rows.shape(0)));
  for (size_t i = 0; i < ticks.size(); ++i)
    std::memcpy(&ticks[i], rows.data(static_cast<py::ssize_t>(i)), sizeof(Tick));
  return ticks;
}

}  // namespace ream::python
