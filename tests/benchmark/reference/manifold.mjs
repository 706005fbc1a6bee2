// Times manifold-3d on two raw meshes: node manifold.mjs OPERATION A B; prints seconds, triangles and volume as JSON.
// Only the Boolean is timed, as for the others: meshes are in memory, and the result is forced by asking for its mesh.
import {readFileSync} from 'node:fs';
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();

// Raw: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
function read(path) {
  const bytes = readFileSync(path);
  const [n, m] = [bytes.readUInt32LE(0), bytes.readUInt32LE(4)];
  const copy = (from, length) => bytes.buffer.slice(bytes.byteOffset + from, bytes.byteOffset + from + length);
  const mesh = new wasm.Mesh({
    numProp: 3,
    vertProperties: Float32Array.from(new Float64Array(copy(8, 24 * n))),
    triVerts: new Uint32Array(copy(8 + 24 * n, 12 * m)),
  });
  return wasm.Manifold.ofMesh(mesh);
}

const [operation, a, b] = process.argv.slice(2);
const [left, right] = [read(a), read(b)];
left.numTri(), right.numTri();
const start = performance.now();
const result = operation === 'union' ? left.add(right) : operation === 'cut' ? left.subtract(right) : left.intersect(right);
const triangles = result.numTri();
result.getMesh();
const seconds = (performance.now() - start) / 1000;
console.log(JSON.stringify({seconds, triangles, volume: typeof result.volume === 'function' ? result.volume() : result.getProperties().volume}));
