/** What the simulator does not model or know, as README.md says it under the same heading. */
export const limitsTitle = 'Limits of this simulator';

export const limits: readonly string[] = [
  'No study has compared the simulator with surgeons yet. It is unknown whether scores separate experts from novices.',
  'The feed rate comes from six cadaver scapulae, reamed by a robot at 52 N. In another cortical bone, the true rate may be 0.5 to 1.5 times as high.',
  'Values for bone of 0.72 to 1.30 g/cc, other forces and other reamers are calculated from these data, not measured.',
  'The bone surface is only as exact as the CT. A blur of one voxel (standard deviation) moves it out by half a voxel. A blur of two voxels moves it by two.',
  'Without a calibration phantom in the scan, densities are estimates, and so are all forces.',
  'Torque and sideways forces come from published cutting experiments in other bones.',
  'Vibration and sound have the published strength and spectrum. They contain no recordings of bone.',
  'Heat is calculated straight down into the bone. In patients, the bone was hot to a greater depth.',
  'Soft tissue, retractors and the humeral head are only drawn: the reamer does not feel them. The scapula stands still unless a script mounts it on springs.',
  'A mouse gives no force. Most devices give less force than a patient does; the page shows the scale.',
  'Weights, pass marks and most limits of the standard rubric are engineering judgement.',
];
