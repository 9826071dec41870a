// Places of a solver's lattice (server/solve/elastic_grid.hpp).

static int3 place_of(struct ElasticGridLayout grid, uint place) {
  const uint z = place / grid.layer, in_layer = place - z * grid.layer, y = in_layer / grid.row;
  return (int3)((int)(in_layer - y * grid.row), (int)y, (int)z);
}

static size_t lattice_index(struct ElasticGridLayout grid, int3 at) {
  return (size_t)at.x + (size_t)grid.row * (size_t)at.y + (size_t)grid.layer * (size_t)at.z;
}
