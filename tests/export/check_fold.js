// Reads FOLD files with the npm package `fold` and says what it makes of their frames, as JSON.
const FOLD = require("fold");
const fs = require("fs");

const ring = (face) => {
  const least = face.indexOf(Math.min(...face));
  return [...face.slice(least), ...face.slice(0, least)].join(",");
};

const checked = process.argv.slice(2).map((path) => {
  const file = JSON.parse(fs.readFileSync(path, "utf8"));
  const copy = () => ({
    vertices_coords: file.vertices_coords.map((spot) => [...spot]),
    edges_vertices: file.edges_vertices.map((edge) => [...edge]),
    edges_assignment: [...file.edges_assignment],
  });
  const near = copy();
  FOLD.filter.collapseNearbyVertices(near, 1e-3);
  const once = copy();
  FOLD.filter.removeDuplicateEdges_vertices(once);
  const crossing = copy();
  FOLD.filter.subdivideCrossingEdges_vertices(crossing, 1e-6);
  const faces = FOLD.convert.edges_vertices_to_faces_vertices(copy()).faces_vertices;
  const found = new Set(faces.map(ring));
  const spots = file.vertices_coords.map(String);
  const alone = (vertex) => spots.indexOf(spots[vertex]) === spots.lastIndexOf(spots[vertex]);
  return {
    vertices: file.vertices_coords.length,
    edges: file.edges_vertices.length,
    apart: near.vertices_coords.length,
    single: once.edges_vertices.length,
    uncrossed: crossing.vertices_coords.length,
    spots: new Set(spots).size,
    // beside a cut, whose two borders run in one direction, faces cannot be told by directions
    missing: file.faces_vertices.filter((face) => face.every(alone) && !found.has(ring(face))).length,
    mountains: FOLD.filter.mountainEdges(file).length,
    valleys: FOLD.filter.valleyEdges(file).length,
  };
});
console.log(JSON.stringify(checked));
