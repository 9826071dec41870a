import { DataTexture, Int8BufferAttribute, Mesh, type MeshStandardMaterial, NearestFilter, type Plane } from 'three';

import { type MapScale, paletteOf } from '../state/review/deviation_scale';
import type { DeviationCode } from '../wire/review_api';
import type { SortedSurface } from '../wire/sorted_surface';
import { boneMaterial, lookOfBone } from './bone_material';
import type { BoneReplacement } from './bone_view';
import { haveBoxes } from './line_hits';
import { surfaceGeometry } from './surface_geometry';

const declareInVertex = `
attribute float deviation;
uniform float unknownCode;
varying float vDeviation;
varying float vKnown;
`;
/** What is between a known and an unknown corner is unknown. */
const vertexAssignment = `
#include <begin_vertex>
vKnown = deviation == unknownCode ? 0.0 : 1.0;
vDeviation = deviation == unknownCode ? 0.0 : deviation;
`;
const declareInFragment = `
uniform sampler2D palette;
uniform float unknownCode;
varying float vDeviation;
varying float vKnown;
`;
/** Lit from the eye and not too much, so that colours stay those of the legend; too deep is hatched over the screen. */
const paintMap = `
float code = vKnown < 0.999 ? unknownCode : vDeviation;
vec4 paint = texture2D(palette, vec2((floor(code + 0.5) + 128.5) / 256.0, 0.5));
float facing = clamp(dot(normal, normalize(vViewPosition)), 0.0, 1.0);
vec3 mapped = paint.rgb * mix(0.5, 1.0, facing);
if (paint.a > 0.5 && fract((gl_FragCoord.x + gl_FragCoord.y) / 7.0) < 0.26) {
  float bright = dot(paint.rgb, vec3(0.2126, 0.7152, 0.0722));
  mapped = mix(mapped, bright > 0.4 ? vec3(0.2, 0.12, 0.3) : vec3(0.9, 0.86, 0.95), 0.55);
}
gl_FragColor = vec4(mapped, gl_FragColor.a);
#include <dithering_fragment>
`;

/** The surface that a session left, painted by how far it lies from something; in the CT's frame. */
export class DeviationSurface implements BoneReplacement {
  readonly object: Mesh;
  private readonly material: MeshStandardMaterial;
  private readonly palette = new DataTexture(new Uint8Array(256 * 4), 256, 1);
  private readonly unknownCode = { value: -128 };
  private code: DeviationCode = { stepMm: 1, rangeMm: 127, unknown: -128 };

  constructor(surface: SortedSurface) {
    const geometry = surfaceGeometry(surface);
    geometry.computeBoundingSphere();
    haveBoxes(geometry, surface.boxes);
    this.palette.minFilter = NearestFilter;
    this.palette.magFilter = NearestFilter;
    this.material = this.mapMaterial();
    this.object = new Mesh(geometry, this.material);
  }

  /** A byte for each corner of the surface. */
  paint(bytes: Int8Array<ArrayBuffer>, code: DeviationCode): void {
    this.object.geometry.setAttribute('deviation', new Int8BufferAttribute(bytes, 1));
    this.unknownCode.value = code.unknown;
    this.code = code;
  }
  setScale(scale: MapScale): void {
    (this.palette.image.data as Uint8Array).set(paletteOf(scale, this.code));
    this.palette.needsUpdate = true;
  }

  setLook(opacity: number, cuts: Plane[]): void {
    lookOfBone(this.material, opacity, cuts);
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    this.material.dispose();
    this.palette.dispose();
  }

  private mapMaterial(): MeshStandardMaterial {
    const material = boneMaterial();
    const paintBone = material.onBeforeCompile.bind(material);
    material.onBeforeCompile = (shader, renderer) => {
      shader.uniforms.palette = { value: this.palette };
      shader.uniforms.unknownCode = this.unknownCode;
      shader.vertexShader = declareInVertex + shader.vertexShader.replace('#include <begin_vertex>', vertexAssignment);
      shader.fragmentShader =
        declareInFragment + shader.fragmentShader.replace('#include <dithering_fragment>', paintMap);
      paintBone(shader, renderer);
    };
    material.customProgramCacheKey = () => 'deviation';
    return material;
  }
}
