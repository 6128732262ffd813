// The little that WebGL2 needs: programs with their uniforms, and arrays on the graphics card.
const glContext = (canvas) => {
  try {
    return canvas.getContext("webgl2", { antialias: true, alpha: false });
  } catch {
    return null;
  }
};

const glProgram = (gl, vertex, fragment) => {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${source}`);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
};

const setUniforms = (gl, { uniforms }, values) => {
  for (const [name, value] of Object.entries(values)) {
    const place = uniforms[name];
    if (typeof value === "number") gl.uniform1f(place, value);
    else if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
    else gl.uniform3fv(place, value);
  }
};

/** A vertex array; `layout` lists per attribute: location, width, buffer, and whether it advances by instance. */
const glArrays = (gl, layout, elements = null) => {
  const arrays = gl.createVertexArray();
  gl.bindVertexArray(arrays);
  for (const { location, width, buffer, stride = 0, offset = 0, instanced = false } of layout) {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, width, gl.FLOAT, false, 4 * stride, 4 * offset);
    if (instanced) gl.vertexAttribDivisor(location, 1);
  }
  if (elements) {
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, elements, gl.STATIC_DRAW);
  }
  gl.bindVertexArray(null);
  return arrays;
};

const glFill = (gl, buffer, data, usage = gl.DYNAMIC_DRAW) => {
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, data, usage);
};
