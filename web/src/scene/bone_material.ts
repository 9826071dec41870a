import { DoubleSide, FrontSide, MeshStandardMaterial, type Plane } from 'three';

import { wholeBoneColour } from './cut_bone';

/**
 * Where bone is cut away one looks at the inside of its surface: painted flat and hatched over the screen, as a drawing
 * shows a section, so that it is told from what the reamer has cut, also without colours.
 */
const paintInside = `
#include <dithering_fragment>
#ifdef DOUBLE_SIDED
if (!gl_FrontFacing) {
  float line = fract((gl_FragCoord.x - gl_FragCoord.y) / 9.0);
  vec3 inside = mix(vec3(0.62, 0.44, 0.36), vec3(0.78, 0.61, 0.51), step(0.22, line));
  gl_FragColor = vec4(inside, 1.0);
}
#endif
`;

/** The bone's surface from outside, ivory; from inside a section. */
export function boneMaterial(): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ color: wholeBoneColour, roughness: 0.72, metalness: 0 });
  material.clipShadows = true;
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', paintInside);
  };
  return material;
}

/** Opacity 0 to 1; what lies on the negative side of any of the planes is not drawn. */
export function lookOfBone(material: MeshStandardMaterial, opacity: number, cuts: Plane[]): void {
  const side = cuts.length > 0 ? DoubleSide : FrontSide;
  const transparent = opacity < 1;
  if (material.side !== side || material.transparent !== transparent) material.needsUpdate = true;
  material.side = side;
  material.transparent = transparent;
  material.opacity = opacity;
  material.clippingPlanes = cuts.length > 0 ? cuts : null;
}

/** Whether a material is compiled with that name. */
export function defineIn(material: MeshStandardMaterial, name: string, wanted: boolean): void {
  const { defines = {} } = material;
  if (wanted === name in defines) return;
  if (wanted) defines[name] = '';
  else delete defines[name];
  material.needsUpdate = true;
}
