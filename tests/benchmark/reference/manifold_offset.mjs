// Times manifold-3d's Minkowski sum of a raw mesh with a ball: node manifold_offset.mjs MESH RADIUS SEGMENTS OUT. Prints JSON, and
// writes the result raw. Raw: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
import {readFileSync, writeFileSync} from 'node:fs';
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();

const [path, radius, segments, out] = process.argv.slice(2);
const bytes = readFileSync(path);
const [n, m] = [bytes.readUInt32LE(0), bytes.readUInt32LE(4)];
const copy = (from, length) => bytes.buffer.slice(bytes.byteOffset + from, bytes.byteOffset + from + length);
const solid = wasm.Manifold.ofMesh(new wasm.Mesh({
  numProp: 3,
  vertProperties: Float32Array.from(new Float64Array(copy(8, 24 * n))),
  triVerts: new Uint32Array(copy(8 + 24 * n, 12 * m)),
}));
const ball = wasm.Manifold.sphere(Number(radius), Number(segments));
solid.numTri();
const start = performance.now();
const result = solid.minkowskiSum(ball);
const triangles = result.numTri();
const mesh = result.getMesh();
const seconds = (performance.now() - start) / 1000;
const points = new Float64Array(3 * mesh.numVert);
for (let v = 0; v < mesh.numVert; ++v)
  for (let k = 0; k < 3; ++k) points[3 * v + k] = mesh.vertProperties[mesh.numProp * v + k];
const head = new Uint32Array([mesh.numVert, mesh.numTri]);
writeFileSync(out, Buffer.concat([head, points, mesh.triVerts].map((a) => Buffer.from(a.buffer, a.byteOffset, a.byteLength))));
console.log(JSON.stringify({seconds, triangles, ball: ball.numTri()}));
