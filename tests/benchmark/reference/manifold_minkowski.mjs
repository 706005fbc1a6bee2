// Times manifold-3d's Minkowski sum of two raw meshes: node manifold_minkowski.mjs A B. Prints JSON.
// Raw: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
import {readFileSync} from 'node:fs';
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();

function read(path) {
  const bytes = readFileSync(path);
  const [n, m] = [bytes.readUInt32LE(0), bytes.readUInt32LE(4)];
  const copy = (from, length) => bytes.buffer.slice(bytes.byteOffset + from, bytes.byteOffset + from + length);
  const solid = wasm.Manifold.ofMesh(new wasm.Mesh({
    numProp: 3,
    vertProperties: Float32Array.from(new Float64Array(copy(8, 24 * n))),
    triVerts: new Uint32Array(copy(8 + 24 * n, 12 * m)),
  }));
  solid.numTri();
  return solid;
}

const [a, b] = process.argv.slice(2).map(read);
const start = performance.now();
const sum = a.minkowskiSum(b);
const triangles = sum.numTri();
const seconds = (performance.now() - start) / 1000;
console.log(JSON.stringify({seconds, triangles, volume: sum.volume(), genus: sum.genus()}));
