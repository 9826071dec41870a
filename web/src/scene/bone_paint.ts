import { Color, Matrix4, type MeshStandardMaterial } from 'three';

import type { Pose, ToolMesh } from '../wire/messages';
import { boneMaterial, defineIn } from './bone_material';
import {
  cutBoneColours,
  cutInFragment,
  cutInVertex,
  cutVertexAssignment,
  paintCut,
  wetCut,
  wholeBoneColour,
} from './cut_bone';
import { faceHeights } from './face_heights';
import {
  paintPores,
  poreColours,
  poresDefine,
  poresInFragment,
  poresInVertex,
  poresVertexAssignment,
  wetPores,
} from './pores';
import { poseMatrix } from './pose_matrix';

/** What the kinds of bone are painted with, apart for every kind of colour vision; CSS colours. */
export const kindColours = { cortical: wholeBoneColour, cancellous: '#d9822b', cartilage: '#5aa2d6' };
/** Where the reamer touches; hatched as well. */
export const contactColour = '#5b2a86';
/** Closer than this to the reamer's face counts as touched, mm: a voxel of a usual case. */
const touchesWithinMm = 0.35;
const heightCount = 33;

/** Defined while the bone is painted by its kinds: a plain one costs no more than it must. */
const painted = 'BONE_PAINTED';

const inVertex = `${cutInVertex}${poresInVertex}
#ifdef ${painted}
uniform mat4 toolFromWorld;
varying vec3 vKinds;
varying vec3 vInTool;
#endif
`;
const vertexAssignment = `
#include <project_vertex>
${cutVertexAssignment}${poresVertexAssignment}
#ifdef ${painted}
float boneKind = boneKindOf(boneMarks);
vKinds = vec3(boneKind == 0.0, boneKind == 1.0, boneKind == 2.0);
vInTool = (toolFromWorld * modelMatrix * vec4(transformed, 1.0)).xyz;
#endif
`;
const inFragment = `${cutInFragment}${poresInFragment}
#ifdef ${painted}
uniform bool contactShown;
uniform vec3 kindColour[3];
uniform vec3 touchedColour;
uniform float faceReachMm;
uniform float faceHeightMm[${heightCount}];
varying vec3 vKinds;
varying vec3 vInTool;

bool touchesReamer() {
  float offAxisMm = length(vInTool.xy);
  if (!contactShown || offAxisMm >= faceReachMm) return false;
  float at = offAxisMm / faceReachMm * ${(heightCount - 1).toFixed(1)};
  int below = int(at);
  float heightMm = mix(faceHeightMm[below], faceHeightMm[below + 1], at - float(below));
  return abs(vInTool.z - heightMm) < ${touchesWithinMm};
}
#endif
`;
const paintKinds = `
#include <color_fragment>
${paintCut}
#ifdef ${painted}
cutShare = 0.0;
float known = vKinds.x + vKinds.y + vKinds.z;
if (known > 0.01) {
  vec3 kind = (kindColour[0] * vKinds.x + kindColour[1] * vKinds.y + kindColour[2] * vKinds.z) / known;
  diffuseColor.rgb = mix(diffuseColor.rgb, kind, min(known, 1.0));
}
if (touchesReamer()) {
  float line = fract((gl_FragCoord.x + gl_FragCoord.y) / 6.0);
  diffuseColor.rgb = mix(diffuseColor.rgb, touchedColour, line < 0.5 ? 0.85 : 0.45);
}
#endif
${paintPores}
diffuseColor.rgb = mix(diffuseColor.rgb, cutBone, cutShare);
`;

/**
 * Paints what of the streamed bone was cut; or, while that is wanted, the bone by its kinds and where the reamer touches
 * it.
 */
export class BonePaint {
  readonly material: MeshStandardMaterial;
  private readonly toolFromWorld = { value: new Matrix4() };
  private readonly boneFromWorld = { value: new Matrix4() };
  private readonly contactShown = { value: false };
  private readonly faceReachMm = { value: 0 };
  private readonly faceHeightMm = { value: new Float32Array(heightCount) };
  private posed = false;
  private wanted = false;
  private touching = false;

  constructor() {
    this.material = boneMaterial();
    const paintInside = this.material.onBeforeCompile.bind(this.material);
    this.material.onBeforeCompile = (shader, renderer) => {
      const { cancellous, cortical, cartilage } = kindColours;
      Object.assign(shader.uniforms, {
        toolFromWorld: this.toolFromWorld,
        boneFromWorld: this.boneFromWorld,
        contactShown: this.contactShown,
        faceReachMm: this.faceReachMm,
        faceHeightMm: this.faceHeightMm,
        kindColour: { value: [cancellous, cortical, cartilage].map((colour) => new Color(colour)) },
        touchedColour: { value: new Color(contactColour) },
        poreColour: { value: [poreColours.wall, poreColours.marrow].map((colour) => new Color(colour)) },
        cutColour: { value: [cutBoneColours.cancellous, cutBoneColours.compact].map((colour) => new Color(colour)) },
      });
      shader.vertexShader = inVertex + shader.vertexShader.replace('#include <project_vertex>', vertexAssignment);
      shader.fragmentShader =
        inFragment +
        shader.fragmentShader
          .replace('#include <color_fragment>', paintKinds)
          .replace('#include <roughnessmap_fragment>', `#include <roughnessmap_fragment>${wetCut}${wetPores}`);
      paintInside(shader, renderer);
    };
    this.material.customProgramCacheKey = () => 'bone by its kinds';
  }

  setTool(tool: ToolMesh): void {
    const { reachMm, heightsMm } = faceHeights(tool, heightCount);
    this.faceReachMm.value = reachMm;
    this.faceHeightMm.value.set(heightsMm);
  }

  setToolPose(pose: Pose | null): void {
    this.posed = pose !== null;
    if (pose !== null) this.toolFromWorld.value.copy(poseMatrix(pose)).invert();
    this.refresh();
  }

  /** How far the bone has moved from where the hello has it: its pores move with it. Null: not at all. */
  setBonePose(worldFromBoneRest: Pose | null): void {
    if (worldFromBoneRest === null) this.boneFromWorld.value.identity();
    else this.boneFromWorld.value.copy(poseMatrix(worldFromBoneRest)).invert();
  }

  /** Whether the reamer presses on bone now. */
  setTouching(touching: boolean): void {
    this.touching = touching;
    this.refresh();
  }

  setWanted(wanted: boolean): void {
    this.wanted = wanted;
    defineIn(this.material, painted, wanted);
    this.refresh();
  }

  /** Whether spongy bone that was cut shows its pores. */
  setPores(shown: boolean): void {
    defineIn(this.material, poresDefine, shown);
  }

  dispose(): void {
    this.material.dispose();
  }

  private refresh(): void {
    this.contactShown.value = this.wanted && this.posed && this.touching;
  }
}
