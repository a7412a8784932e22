"""Binary STL of one fold angle: the printed sides as triangles, mm."""

from pathlib import Path

import numpy as np

from popsim.export.solid.scene import Scene, placed

HEADER = b"popsim, millimetres"


def write_stl(scene: Scene, path: Path) -> tuple[Path, ...]:
    """Write all leaves at the first fold angle of `scene`; the same scene gives the same bytes."""
    triangles = np.concatenate([placed(scene, k) for k in range(len(scene.leaves))])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    records = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    records["normal"], records["corners"] = normals, triangles
    path.write_bytes(HEADER.ljust(80) + np.uint32(len(triangles)).tobytes() + records.tobytes())
    return (path,)
