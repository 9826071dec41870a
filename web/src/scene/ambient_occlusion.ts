import {
  DepthTexture,
  DoubleSide,
  Matrix4,
  type MeshStandardMaterial,
  MeshBasicMaterial,
  type PerspectiveCamera,
  type Plane,
  type Scene,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';

import { defineIn } from './bone_material';
import { solidLayer } from './lights';

/** What is farther from a place takes no light from it, mm. */
const reachMm = 5;
/** Distances are drawn at this part of the picture's size. */
const depthScale = 0.5;
/** How much light what is near takes. Chosen by eye. */
const strength = 0.11;
/** What is left of the lamps' light at the least. Chosen by eye. */
const leastOfLamps = 0.75;
/** Parts of the reach: nearer than this a surface is as even as it is drawn. */
const evenWithin = 0.02;
/** Defined while materials are drawn with it. */
const occludedDefine = 'OCCLUDED';

/**
 * Places that see little around them get less light from all around: the less, the more of what is near stands above their
 * surface, as far as the picture shows it. After McGuire, Osman, Bukowski and Hennessy 2011 ("The Alchemy screen-space ambient
 * obscurance algorithm"), with an end to the reach; samples on a spiral that is turned by the noise of Jimenez 2014.
 */
const inFragment = `
#ifdef ${occludedDefine}
uniform sampler2D solidDepth;
uniform mat4 viewFromClip;
uniform vec2 picturePixels;
uniform float pixelsPerMmAtOne;

// The depth of a texel is that of its middle.
vec3 solidAt(vec2 uv) {
  vec2 texels = vec2(textureSize(solidDepth, 0));
  vec2 middle = (floor(uv * texels) + 0.5) / texels;
  vec4 at = viewFromClip * vec4(vec3(middle, texture2D(solidDepth, middle).r) * 2.0 - 1.0, 1.0);
  return at.xyz / at.w;
}

float openShare(vec3 at, vec3 outward) {
  float reachPixels = ${reachMm.toFixed(1)} * pixelsPerMmAtOne / -at.z;
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float hidden = 0.0;
  for (int i = 0; i < 16; ++i) {
    float part = (float(i) + 0.5) / 16.0;
    float angle = turn + 2.3999632 * float(i);
    vec2 uv = (gl_FragCoord.xy + part * reachPixels * vec2(cos(angle), sin(angle))) / picturePixels;
    vec3 apart = (solidAt(uv) - at) / ${reachMm.toFixed(1)};
    float far = dot(apart, apart);
    float above = max(0.0, dot(apart, outward) - ${evenWithin});
    hidden += above / (far + ${evenWithin}) * max(0.0, 1.0 - far);
  }
  return clamp(1.0 - hidden * ${strength}, 0.0, 1.0);
}
#endif
`;
/** After all light has been added up. Lamps of a theatre are wide: part of them is hidden, too. */
const afterLights = `
#include <lights_fragment_end>
#ifdef ${occludedDefine}
float openAround = openShare(-vViewPosition, normal);
reflectedLight.indirectDiffuse *= openAround;
reflectedLight.indirectSpecular *= openAround;
reflectedLight.directDiffuse *= mix(${leastOfLamps}, 1.0, openAround);
#endif
`;

/** Makes the hollows of what it darkens darker. */
export class AmbientOcclusion {
  private readonly depthOnly = new MeshBasicMaterial({ colorWrite: false, side: DoubleSide });
  private readonly solidDepth: { value: DepthTexture | null } = { value: null };
  private readonly viewFromClip = { value: new Matrix4() };
  private readonly picturePixels = { value: new Vector2() };
  private readonly pixelsPerMmAtOne = { value: 1 };
  private readonly materials: MeshStandardMaterial[] = [];
  private target: WebGLRenderTarget | null = null;

  /** That material is drawn with it wherever it is on. */
  darken(material: MeshStandardMaterial): void {
    this.materials.push(material);
    const key = material.customProgramCacheKey();
    material.customProgramCacheKey = () => `occluded ${key}`;
    const before = material.onBeforeCompile.bind(material);
    material.onBeforeCompile = (shader, renderer) => {
      const { solidDepth, viewFromClip, picturePixels, pixelsPerMmAtOne } = this;
      Object.assign(shader.uniforms, { solidDepth, viewFromClip, picturePixels, pixelsPerMmAtOne });
      shader.fragmentShader = inFragment + shader.fragmentShader.replace('#include <lights_fragment_end>', afterLights);
      before(shader, renderer);
    };
  }

  /**
   * To be called before each picture of that scene. What lies on the negative side of any plane hides nothing, be it bone or
   * a tool.
   */
  prepare(on: boolean, renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, cuts: Plane[]): void {
    for (const material of this.materials) defineIn(material, occludedDefine, on);
    if (on) this.drawDepth(renderer, scene, camera, cuts);
    else this.drop();
  }

  dispose(): void {
    this.drop();
    this.depthOnly.dispose();
  }

  private drawDepth(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, cuts: Plane[]): void {
    const size = renderer.getDrawingBufferSize(this.picturePixels.value);
    const target = this.targetOf(Math.ceil(depthScale * size.x), Math.ceil(depthScale * size.y));
    this.viewFromClip.value.copy(camera.projectionMatrixInverse);
    this.pixelsPerMmAtOne.value = 0.5 * size.y * (camera.projectionMatrix.elements[5] ?? 1);
    this.depthOnly.clippingPlanes = cuts.length > 0 ? cuts : null;
    const { mask } = camera.layers;
    const shadows = renderer.shadowMap.autoUpdate;
    camera.layers.set(solidLayer);
    renderer.shadowMap.autoUpdate = false;
    scene.overrideMaterial = this.depthOnly;
    renderer.setRenderTarget(target);
    try {
      renderer.render(scene, camera);
    } finally {
      renderer.setRenderTarget(null);
      scene.overrideMaterial = null;
      renderer.shadowMap.autoUpdate = shadows;
      camera.layers.mask = mask;
    }
  }

  private targetOf(width: number, height: number): WebGLRenderTarget {
    if (this.target?.width === width && this.target.height === height) return this.target;
    this.drop();
    const depthTexture = new DepthTexture(width, height);
    this.target = new WebGLRenderTarget(width, height, { depthTexture });
    this.solidDepth.value = depthTexture;
    return this.target;
  }

  private drop(): void {
    this.target?.dispose();
    this.target = null;
    this.solidDepth.value = null;
  }
}
