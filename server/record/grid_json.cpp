#include "record/grid_json.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace ream::record {

using nlohmann::json;

std::string grid_to_text(const voxel::VoxelGrid& grid) {
  const auto list = [](const auto& v) { return json{v.x(), v.y(), v.z()}; };
  json rotation = json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation.push_back(grid.world_from_grid.rotation(row, column));
  return json{{"dims", list(grid.dims)},
              {"spacing_mm", list(grid.spacing_mm)},
              {"world_from_grid",
               {{"rotation", rotation}, {"translation_mm", list(grid.world_from_grid.translation_mm)}}}}
      .dump();
}

voxel::VoxelGrid grid_from_text(const std::string& text) {
  try {
    const json grid = json::parse(text);
    const auto vector = [](const json& list) {
      return Vec3(list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>());
    };
    voxel::VoxelGrid read;
    for (int axis = 0; axis < 3; ++axis)
      read.dims[axis] = grid.at("dims").at(static_cast<size_t>(axis)).get<int>();
    read.spacing_mm = vector(grid.at("spacing_mm"));
    const json& pose = grid.at("world_from_grid");
    for (int i = 0; i < 9; ++i)
      read.world_from_grid.rotation(i / 3, i % 3) =
          pose.at("rotation").at(static_cast<size_t>(i)).get<double>();
    read.world_from_grid.translation_mm = vector(pose.at("translation_mm"));
    voxel::validate(read);
    return read;
  } catch (const json::exception& e) {
    throw Error(ErrorKind::invalid_input, std::string("the recording's grid cannot be read: ") + e.what());
  }
}

}  // namespace ream::record
