#include "openigtlink/messages.hpp"

#include <igtlSensorMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>
#include <igtl_header.h>
#include <igtl_polydata.h>
#include <igtl_unit.h>
#include <igtl_util.h>
#include <algorithm>
#include <cstring>
#include <limits>

#include "core/error.hpp"

namespace ream::openigtlink {
namespace {

constexpr int64_t ns_per_s = 1'000'000'000;
/// IANA's number of UTF-8.
constexpr igtlUint16 utf8_mib = 106;
constexpr size_t max_string_bytes = 65535;
constexpr char normals_name[] = "Normals";

igtlUint32 seconds_of(const Label& label) { return static_cast<igtlUint32>(label.unix_ns / ns_per_s); }
igtlUint32 nanoseconds_of(const Label& label) { return static_cast<igtlUint32>(label.unix_ns % ns_per_s); }

template <typename LibraryMessage>
Message packed(const Label& label, LibraryMessage& message) {
  igtl::TimeStamp::Pointer stamp = igtl::TimeStamp::New();
  stamp->SetTime(seconds_of(label), nanoseconds_of(label));
  message.SetDeviceName(label.name.c_str());
  message.SetTimeStamp(stamp);
  message.Pack();
  const auto* first = static_cast<const std::byte*>(message.GetPackPointer());
  return std::make_shared<const std::vector<std::byte>>(first, first + message.GetPackSize());
}

igtl_unit packed_unit(SensorUnit unit) {
  igtl_unit_data data;
  igtl_unit_init(&data);
  data.unit[0] = IGTL_UNIT_SI_DERIVED_NEWTON;
  data.exp[0] = 1;
  if (unit == SensorUnit::newton_metre) {
    data.unit[1] = IGTL_UNIT_SI_BASE_METER;
    data.exp[1] = 1;
  }
  return igtl_unit_pack(&data);
}

/// The library's own form of a surface; it refers to what it was made of.
struct Surface {
  explicit Surface(const TriangleMesh& mesh);

  std::vector<igtl_uint32> polygons;  ///< 3 and three indices each
  igtl_polydata_attribute normals{};
  char name[sizeof normals_name];
  igtl_polydata_info info{};
};

static_assert(sizeof(Vec3f) == 3 * sizeof(igtl_float32));

/// The library reads what it packs, though its types do not say so.
igtl_float32* floats_of(const std::vector<Vec3f>& vectors) {
  return const_cast<igtl_float32*>(reinterpret_cast<const igtl_float32*>(vectors.data()));
}

Surface::Surface(const TriangleMesh& mesh) {
  const uint64_t polygon_bytes = mesh.triangles.size() * 4 * sizeof(igtl_uint32);
  if (std::max<uint64_t>(polygon_bytes, mesh.vertices_mm.size()) > std::numeric_limits<igtl_uint32>::max())
    throw Error(ErrorKind::invalid_input, "a surface of " + std::to_string(mesh.triangles.size()) +
                                              " triangles is too large for an OpenIGTLink message");
  polygons.reserve(mesh.triangles.size() * 4);
  for (const auto& triangle : mesh.triangles)
    polygons.insert(polygons.end(), {3, triangle[0], triangle[1], triangle[2]});
  igtl_polydata_init_info(&info);
  info.header.npoints = static_cast<igtl_uint32>(mesh.vertices_mm.size());
  info.points = floats_of(mesh.vertices_mm);
  info.header.npolygons = static_cast<igtl_uint32>(mesh.triangles.size());
  info.header.size_polygons = static_cast<igtl_uint32>(polygon_bytes);
  info.polygons = polygons.data();
  if (mesh.normals.empty()) return;
  std::memcpy(name, normals_name, sizeof name);
  normals = {IGTL_POLY_ATTR_TYPE_NORMAL, 3, static_cast<igtl_uint32>(mesh.normals.size()), name,
             floats_of(mesh.normals)};
  info.header.nattributes = 1;
  info.attributes = &normals;
}

template <size_t n>
void put_text(char (&field)[n], const std::string& text) {
  std::memset(field, 0, n);
  std::memcpy(field, text.data(), std::min(text.size(), n));
}

}  // namespace

const Pose& ras_from_world() {
  static const Pose half_turn{Vec3(-1.0, -1.0, 1.0).asDiagonal(), Vec3::Zero()};
  return half_turn;
}

Pose ras_from(const Pose& world_from_thing) { return ras_from_world() * world_from_thing; }

Pose moved_in_ras(const Pose& world_from_rest) {
  return ras_from_world() * world_from_rest * ras_from_world().inverse();
}

Message transform_message(const Label& label, const Pose& ras_from_thing) {
  igtl::Matrix4x4 matrix;
  igtl::IdentityMatrix(matrix);
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      matrix[row][column] = static_cast<float>(ras_from_thing.rotation(row, column));
    matrix[row][3] = static_cast<float>(ras_from_thing.translation_mm[row]);
  }
  igtl::TransformMessage::Pointer message = igtl::TransformMessage::New();
  message->SetMatrix(matrix);
  return packed(label, *message);
}

Message polydata_message(const Label& label, const TriangleMesh& mesh) {
  Surface surface(mesh);
  const uint64_t body_bytes = igtl_polydata_get_size(&surface.info, IGTL_TYPE_PREFIX_NONE);
  auto bytes = std::make_shared<std::vector<std::byte>>(IGTL_HEADER_SIZE + body_bytes);
  auto* body = reinterpret_cast<unsigned char*>(bytes->data()) + IGTL_HEADER_SIZE;
  igtl_polydata_pack(&surface.info, body, IGTL_TYPE_PREFIX_NONE);
  igtl_header header{};
  header.version = IGTL_HEADER_VERSION;
  put_text(header.name, "POLYDATA");
  put_text(header.device_name, label.name);
  header.timestamp =
      static_cast<uint64_t>(seconds_of(label)) << 32 | igtl_nanosec_to_frac(nanoseconds_of(label));
  header.body_size = body_bytes;
  header.crc = crc64(body, body_bytes, 0);
  igtl_header_convert_byte_order(&header);
  std::memcpy(bytes->data(), &header, IGTL_HEADER_SIZE);
  return bytes;
}

Message sensor_message(const Label& label, std::span<const double> values, SensorUnit unit) {
  igtl::SensorMessage::Pointer message = igtl::SensorMessage::New();
  message->SetLength(static_cast<unsigned int>(values.size()));
  message->SetUnit(packed_unit(unit));
  for (size_t i = 0; i < values.size(); ++i) message->SetValue(static_cast<unsigned int>(i), values[i]);
  return packed(label, *message);
}

Message string_message(const Label& label, const std::string& text) {
  igtl::StringMessage::Pointer message = igtl::StringMessage::New();
  message->SetEncoding(utf8_mib);
  message->SetString(text.substr(0, max_string_bytes).c_str());
  return packed(label, *message);
}

Message status_message(const Label& label, StatusCode code, const std::string& name,
                       const std::string& text) {
  igtl::StatusMessage::Pointer message = igtl::StatusMessage::New();
  message->SetCode(static_cast<int>(code));
  message->SetSubCode(0);  // else it is whatever lay in memory
  message->SetErrorName(name.substr(0, 19).c_str());
  message->SetStatusString(text.c_str());
  return packed(label, *message);
}

}  // namespace ream::openigtlink
