// The bone's bytes, one a voxel: in one buffer, or where the device does not allocate as much at once in PARTS (2 or 4)
// of 2^PART_SHIFT voxels each (server/collide/bone_buffers.hpp). A brick never crosses from one part to the next, so a
// pointer to one of its voxels reaches the others.
//   BONE_PARTS(global const uchar, coverage)  declares the parameters
//   PASS_PARTS(coverage)                      hands them on
//   AT_VOXEL(coverage, voxel)                 is the address of a voxel

#if PARTS == 1

#define BONE_PARTS(type, name) type* name
#define PASS_PARTS(name) name
#define AT_VOXEL(name, voxel) ((name) + (voxel))

#else

#if PARTS == 2
#define BONE_PARTS(type, name) type *name##0, type *name##1
#define PASS_PARTS(name) name##0, name##1
#define PICK_PART(name, part) ((part) == 0 ? name##0 : name##1)
#else
#define BONE_PARTS(type, name) type *name##0, type *name##1, type *name##2, type *name##3
#define PASS_PARTS(name) name##0, name##1, name##2, name##3
#define PICK_PART(name, part) \
  ((part) < 2 ? ((part) == 0 ? name##0 : name##1) : ((part) == 2 ? name##2 : name##3))
#endif

#define AT_VOXEL(name, voxel) \
  (PICK_PART(name, (uint)(voxel) >> PART_SHIFT) + ((uint)(voxel) & ((1u << PART_SHIFT) - 1)))

#endif
