// Times manifold-3d's union of many tessellated spheres or struts: node manifold_round.mjs FILE, a JSON list of
// {ball: [x, y, z], radius} and {strut: [from, to], radius}, and the number of segments that meets the error.
// Making the tessellations counts: they are how Manifold gets there, as subdivision is for others.
import {readFileSync} from 'node:fs';
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();
const {solids} = JSON.parse(readFileSync(process.argv[2]));

function strut([from, to], radius, segments) {
  const axis = to.map((x, k) => x - from[k]), length = Math.hypot(...axis), [x, y, z] = axis.map((c) => c / length);
  const side = Math.hypot(x, y), across = side > 1e-12 ? [-y / side, x / side, 0] : [1, 0, 0];
  const third = [y * across[2] - z * across[1], z * across[0] - x * across[2], x * across[1] - y * across[0]];
  return wasm.Manifold.cylinder(length, radius, radius, segments).transform([...across, 0, ...third, 0, x, y, z, 0, ...from, 1]);
}

const start = performance.now();
const parts = solids.map((s) => s.ball ? wasm.Manifold.sphere(s.radius, s.segments).translate(s.ball) : strut(s.strut, s.radius, s.segments));
const result = wasm.Manifold.union(parts);
const triangles = result.numTri();
result.getMesh();
const seconds = (performance.now() - start) / 1000;
console.log(JSON.stringify({seconds, triangles, volume: typeof result.volume === 'function' ? result.volume() : result.getProperties().volume}));
