// Yau et al. as thesis 4.6.4 makes them parallel: one work-item per voxel of the volume of interest, tested against the
// cap that the cutting lips sweep.

kernel void cap_contact(global const uchar* voxmap, global struct YauExchange* e) {
  const int column = (int)get_global_id(0), row = (int)get_global_id(1);
  if (column >= e->size[0]) return;
  const int iu = e->low[0] + column, iv = e->low[1] + row % e->size[1], iw = e->low[2] + row / e->size[1];
  const float u = (float)iu, v = (float)iv, w = (float)iw;
  global const float* m = e->tool_from_voxel.m;
  global const float* t = e->tool_from_voxel.t;
  const float x = m[0] * u + m[1] * v + m[2] * w + t[0];
  const float y = m[3] * u + m[4] * v + m[5] * w + t[1];
  const float z = m[6] * u + m[7] * v + m[8] * w + t[2];
  const float h = z - e->centre_z;
  if (z < e->plane_z || (x * x + y * y) * e->inverse_a2 + h * h * e->inverse_b2 > 1.0f) return;
  const uchar gray = voxmap[(uint)iu + (uint)e->dims[0] * ((uint)iv + (uint)e->dims[1] * (uint)iw)];
  if (gray == 0) return;
  atomic_add(&e->collided, 1);
  atomic_add(&e->gray_sixteenths, gray / 16);
}
