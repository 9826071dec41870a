// Zheng et al. as thesis 1.6.3 and 4.6.3 describe them: one work-item per point, its voxel found by dividing the grid
// from the top down, its force written apart, then a parallel reduction.

#define REDUCTION_ITEMS 256

kernel void find_voxels(global const float* points, global const float* gray, global uchar* collided,
                        global const struct ZhengArguments* a, global float4* forces) {
  const uint i = get_global_id(0);
  if (i >= a->points) return;
  const float x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
  global const float* m = a->voxel_from_tool.m;
  global const float* t = a->voxel_from_tool.t;
  const float u = m[0] * x + m[1] * y + m[2] * z + t[0];
  const float v = m[3] * x + m[4] * y + m[5] * z + t[1];
  const float w = m[6] * x + m[7] * y + m[8] * z + t[2];
  float4 force = (float4)(0.0f);
  if (u >= 0.0f && v >= 0.0f && w >= 0.0f && u < (float)a->dims[0] && v < (float)a->dims[1] && w < (float)a->dims[2]) {
    int low_u = 0, low_v = 0, low_w = 0;
    for (int edge = a->root_edge / 2; edge > 0; edge /= 2) {
      if (u >= (float)(low_u + edge)) low_u += edge;
      if (v >= (float)(low_v + edge)) low_v += edge;
      if (w >= (float)(low_w + edge)) low_w += edge;
    }
    const uint voxel = (uint)low_u + (uint)a->dims[0] * ((uint)low_v + (uint)a->dims[1] * (uint)low_w);
    const float value = gray[voxel];
    if (value > 0.0f) {
      collided[voxel] = 1;
      const float strength = value * a->force_scale;
      force = (float4)(strength * (a->centre[0] - x), strength * (a->centre[1] - y), strength * (a->centre[2] - z), 1.0f);
    }
  }
  forces[i] = force;
}

// Each work-group adds up to 2 * REDUCTION_ITEMS forces into one.
kernel __attribute__((reqd_work_group_size(REDUCTION_ITEMS, 1, 1))) void reduce(global const float4* in, uint count,
                                                                              global float4* out) {
  local float4 sums[REDUCTION_ITEMS];
  const uint lane = get_local_id(0);
  const uint first = get_group_id(0) * 2 * REDUCTION_ITEMS + lane, second = first + REDUCTION_ITEMS;
  float4 sum = (float4)(0.0f);
  if (first < count) sum += in[first];
  if (second < count) sum += in[second];
  sums[lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint half_count = REDUCTION_ITEMS / 2; half_count > 0; half_count /= 2) {
    if (lane < half_count) sums[lane] += sums[lane + half_count];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (lane == 0) out[get_group_id(0)] = sums[0];
}
