// The thesis' narrow phase (sections 4.3 to 4.5): one work-item per point of the shell.

static uint gather_bits_10(uint x) {
  x &= 0x09249249;
  x = (x | (x >> 2)) & 0x030c30c3;
  x = (x | (x >> 4)) & 0x0300f00f;
  x = (x | (x >> 8)) & 0x030000ff;
  return (x | (x >> 16)) & 0x3ff;
}

kernel void flat_contact(global const uint* codes, global uchar* voxmap,
                         global struct FlatExchange* exchange) {
  const uint i = get_global_id(0);
  if (i >= exchange->points) return;
  const uint code = codes[i];
  const float x = exchange->origin[0] + ((float)gather_bits_10(code) + 0.5f) * exchange->spacing;
  const float y = exchange->origin[1] + ((float)gather_bits_10(code >> 1) + 0.5f) * exchange->spacing;
  const float z = exchange->origin[2] + ((float)gather_bits_10(code >> 2) + 0.5f) * exchange->spacing;
  if (x < exchange->voi_low[0] || y < exchange->voi_low[1] || z < exchange->voi_low[2] ||
      x > exchange->voi_high[0] || y > exchange->voi_high[1] || z > exchange->voi_high[2])
    return;
  global const float* m = exchange->voxel_from_tool.m;
  global const float* t = exchange->voxel_from_tool.t;
  const float u = m[0] * x + m[1] * y + m[2] * z + t[0];
  const float v = m[3] * x + m[4] * y + m[5] * z + t[1];
  const float w = m[6] * x + m[7] * y + m[8] * z + t[2];
  const int dx = exchange->dims[0], dy = exchange->dims[1], dz = exchange->dims[2];
  if (!(u >= 0.0f && v >= 0.0f && w >= 0.0f && u < (float)dx && v < (float)dy && w < (float)dz)) return;
  const uint voxel = (uint)(int)u + (uint)dx * ((uint)(int)v + (uint)dy * (uint)(int)w);
  const uchar gray = voxmap[voxel];
  if (gray == 0) return;
  if (exchange->decay != 0) voxmap[voxel] = (uchar)(gray > exchange->decay ? gray - exchange->decay : 0);
  const float strength = (float)gray * exchange->force_scale;
  atomic_add(&exchange->force[0], (int)(strength * (exchange->centre[0] - x)));
  atomic_add(&exchange->force[1], (int)(strength * (exchange->centre[1] - y)));
  atomic_add(&exchange->force[2], (int)(strength * (exchange->centre[2] - z)));
  atomic_add(&exchange->inside, 1);
}
