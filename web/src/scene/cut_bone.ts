// What the reamer has cut is painted on the bone wherever it is seen: bleeding, darker than bone that is whole, and wet.
import { goneStep, mostGone } from '../wire/bone_marks';

/** As bone that is whole is drawn; sRGB. */
export const wholeBoneColour = '#f2e8d5';
/** Three times darker and more than bone that is whole, so that it is told from it without colours, too. */
export const cutBoneColours = { cancellous: '#8a3d40', compact: '#a2544f' };

/** Of a vertex's attribute by which it says what is known of the bone there (wire/bone_marks). */
export const marksAttribute = 'boneMarks';

/** Where so much of half a voxel is gone the bone is cut. */
export const cutFrom = 0.3;
const wetRoughness = 0.34;

export const cutInVertex = `
attribute float ${marksAttribute};
varying float vGone;
varying float vSpongy;
float boneKindOf(float marks) { return mod(marks, ${goneStep.toFixed(1)}) - 1.0; }
float boneGoneOf(float marks) { return mod(floor(marks / ${goneStep.toFixed(1)}), ${(mostGone + 1).toFixed(1)}); }
float boneDensityOf(float marks) { return floor(marks / ${(goneStep * (mostGone + 1)).toFixed(1)}); }
`;
export const cutVertexAssignment = `
vGone = boneGoneOf(${marksAttribute}) / ${mostGone.toFixed(1)};
vSpongy = boneKindOf(${marksAttribute}) == 1.0 ? 0.0 : 1.0;
`;
export const cutInFragment = `
uniform vec3 cutColour[2];
varying float vGone;
varying float vSpongy;
`;
/** After <color_fragment>; the edge is as sharp as the picture, however large the triangles are. */
export const paintCut = `
float cutEdge = max(0.5 * fwidth(vGone), 0.02);
float cutShare = smoothstep(${cutFrom} - cutEdge, ${cutFrom} + cutEdge, vGone);
vec3 cutBone = mix(cutColour[1], cutColour[0], vSpongy);
`;
/** After <roughnessmap_fragment>. */
export const wetCut = `
roughnessFactor = mix(roughnessFactor, ${wetRoughness}, cutShare);
`;
