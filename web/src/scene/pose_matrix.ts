import { Matrix4, Quaternion, Vector3 } from 'three';

import type { Pose } from '../wire/pose';

/** Takes what is given in the pose's own frame to the frame that the pose is given in; mm. */
export const poseMatrix = ({ translationMm, rotationXyzw }: Pose): Matrix4 =>
  new Matrix4().compose(new Vector3(...translationMm), new Quaternion(...rotationXyzw), new Vector3(1, 1, 1));
