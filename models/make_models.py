"""Makes the models of this folder: `python models/make_models.py [--output FOLDER]`.

Every run writes the same bytes. numpy and Pillow are all it needs.
"""

import argparse
from pathlib import Path

from modelling.hotel import hotel
from modelling.monster_truck import monster_truck
from modelling.plain import half_sphere, skewed_cube, t_shape
from modelling.ship import COLOURS, ship
from modelling.tower import tower
from modelling.town_hall import town_hall
from modelling.truck import truck
from modelling.writers import write_glb, write_obj, write_off, write_ply, write_stl, write_text_stl

_PAINT = {"paint": (1.0, 1.0, 1.0)}


def main() -> None:
    """Write all models."""
    parser = argparse.ArgumentParser(description="Make the models of this folder.")
    parser.add_argument("--output", type=Path, default=Path(__file__).resolve().parent)
    make_models(parser.parse_args().output)


def make_models(folder: Path) -> None:
    """Write every model into its own subfolder of `folder`."""
    for maker, name in ((truck, "truck/truck.obj"), (town_hall, "town_hall/town_hall.obj")):
        mesh, image = maker()
        write_obj(_place(folder, name), mesh, _PAINT, image)
    for maker, name in ((monster_truck, "monster_truck/monster_truck.glb"), (hotel, "hotel/hotel.glb")):
        mesh, image = maker()
        write_glb(_place(folder, name), mesh, image)
    mesh, image = tower()
    write_ply(_place(folder, "tower/tower.ply"), mesh, image)
    write_obj(_place(folder, "ship/ship.obj"), ship(), COLOURS)
    write_text_stl(_place(folder, "t_shape/t_shape.stl"), t_shape())
    write_off(_place(folder, "skewed_cube/skewed_cube.off"), skewed_cube())
    write_stl(_place(folder, "half_sphere/half_sphere.stl"), half_sphere())


def _place(folder: Path, name: str) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


if __name__ == "__main__":
    main()
