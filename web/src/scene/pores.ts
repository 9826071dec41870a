// Spongy bone that was cut shows its pores, full of marrow, between walls: the more bone there is by the CT's density, the
// thicker the walls. Where each pore lies is made up, the share of bone is not.
import { densityStepGCc } from '../wire/bone_marks';

/** Defined while pores are drawn: a plain picture costs no more than it must. */
export const poresDefine = 'BONE_PORES';

/**
 * Apparent density of bone without pores, g/cc, by which 11 to 45 % of bone (the glenoid's: Frich and others 1998) are 0.20
 * to 0.81 g/cc.
 */
const solidBoneGCc = 1.8;
/** Between the middles of pores, mm. Chosen by eye: large enough to be seen from where one reams. */
const poreSpacingMm = 0.8;
/** As all that was cut they are three times darker and more than bone that is whole. */
export const poreColours = { wall: '#a2554a', marrow: '#752a30' };
/** Of steel 0.3, of dry bone 0.7. */
const wallRoughness = 0.45;
const marrowRoughness = 0.2;
/** More than spongy bone has: thicker walls are not told apart. */
const greatestShare = 0.8;

/**
 * How far from a wall's middle it ends, by the share of bone, both in GLSL and in TypeScript: as the difference of the
 * distances to the two nearest of points strewn one a cell (Worley 1996), in cells. Fitted to the share of space that is
 * nearer.
 */
export const wallLimitFormula = 'share * (0.2585 + share * (0.05 + share * 0.138))';

export const poresInVertex = `
#ifdef ${poresDefine}
uniform mat4 boneFromWorld;
varying vec3 vInPores;
varying float vBoneShare;
#endif
`;
/** `boneMarks` as bone_marks has them; its density is 0 where none is told. */
export const poresVertexAssignment = `
#ifdef ${poresDefine}
vInPores = (boneFromWorld * modelMatrix * vec4(transformed, 1.0)).xyz / ${poreSpacingMm.toFixed(2)};
vBoneShare = boneDensityOf(boneMarks) * ${(densityStepGCc / solidBoneGCc).toFixed(6)};
#endif
`;

/** Points by the hash of Jarzynski and Olano 2020 ("Hash functions for GPU rendering", pcg3d). */
export const poresInFragment = `
#ifdef ${poresDefine}
uniform vec3 poreColour[2];
varying vec3 vInPores;
varying float vBoneShare;

vec3 inCell(ivec3 cell) {
  uvec3 v = uvec3(cell) * 1664525u + 1013904223u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  return vec3(v) / 4294967295.0;
}

float offWall(vec3 at) {
  ivec3 home = ivec3(floor(at));
  float first = 9.0;
  float second = 9.0;
  for (int i = 0; i < 27; ++i) {
    ivec3 cell = home + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    vec3 apart = vec3(cell) + inCell(cell) - at;
    float far = dot(apart, apart);
    second = min(second, max(first, far));
    first = min(first, far);
  }
  return sqrt(second) - sqrt(first);
}

// Whether there is bone, 0 to 1; from afar its share. A pixel's size in cells.
float wallAt(vec3 at, float pixel) {
  float share = clamp(vBoneShare, 0.0, ${greatestShare.toFixed(2)});
  float limit = ${wallLimitFormula};
  // The difference of two distances changes by up to twice the way.
  float wall = 1.0 - smoothstep(limit - pixel, limit + pixel, offWall(at));
  return mix(wall, share, smoothstep(0.3, 0.7, pixel));
}
#endif
`;
/** After the colour of what was cut: needs cutShare, vSpongy and cutBone. */
export const paintPores = `
#ifdef ${poresDefine}
float porePixel = max(length(fwidth(vInPores)), 1e-4);
float poreShare = 0.0;
float wall = 1.0;
if (cutShare > 0.0 && vSpongy > 0.0 && vBoneShare > 0.0) {
  wall = wallAt(vInPores, porePixel);
  // One step of density says that it is told at all.
  poreShare = vSpongy * min(vBoneShare * ${(solidBoneGCc / densityStepGCc).toFixed(2)}, 1.0);
  cutBone = mix(cutBone, mix(poreColour[1], poreColour[0], wall), poreShare);
}
#endif
`;
/** After the roughness of what was cut. */
export const wetPores = `
#ifdef ${poresDefine}
roughnessFactor = mix(roughnessFactor, mix(${marrowRoughness}, ${wallRoughness}, wall), cutShare * poreShare);
#endif
`;
