/** As the makers of drivers call what draws without a graphics processor. */
const softwareNames = /llvmpipe|softpipe|swiftshader|software|basic render/i;

/** Whether this is the name of what draws by the computer's processor. */
export const isSoftware = (rendererName: string): boolean => softwareNames.test(rendererName);

/** Whether WebGL is drawn by the computer's processor here, which takes twice as long for smooth edges. */
export function drawsInSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) return false;
  const named = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(named === null ? gl.RENDERER : named.UNMASKED_RENDERER_WEBGL));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return isSoftware(name);
}
