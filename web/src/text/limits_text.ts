/** What the simulator does not know, as README.md says it under the same heading. */
export const limitsTitle = 'What this simulator does not know';

export const limits: readonly string[] = [
  'No study has compared it with surgeons yet: nobody knows whether its points tell experts from novices.',
  'How fast the reamer sinks comes from six cadaver scapulae, reamed by a robot at 52 N. In a new cortical bone the true speed may be half as fast again, or half as fast.',
  'Bone of 0.72 to 1.30 g/cc, other forces and other reamers are calculated from these data, not measured.',
  'A bone’s surface is as exact as its CT. Blur of one voxel (standard deviation) puts it half a voxel outside, blur of two voxels two.',
  'Without a calibration phantom in the scan, densities are estimates, and so are all forces.',
  'Torque and sideways forces come from published cutting experiments in other bones.',
  'Vibration and sound have the published strength and spectrum. No recorded bone is in them.',
  'Heat is calculated straight down into the bone. Patients’ bones were hot to a greater depth than it says.',
  'Soft tissue, retractors, the humeral head, blood and chips are missing, and the scapula stands still unless a script mounts it on springs.',
  'A mouse gives no force, and most devices give less than a patient does: the page shows the scale.',
  'Weights, marks and most limits of the standard rubric are engineering judgement.',
];
