"""Which sides of the paper are seen though nothing is printed on them."""


def bare_sides(fins: tuple[str, ...], reverse: str | None) -> tuple[str, ...]:
    """Tell of fins, whose reverse is seen as well as their front.

    Parameters
    ----------
    fins:
        Ids of the patches that rise through slits.
    reverse:
        Colour of the side of the paper that is not printed, None for white.
    """
    colour = "white" if reverse is None else f"of the colour {reverse}"
    return tuple(
        f"{name} rises through a slit and is seen from both sides; its reverse stays {colour}: colour it, or glue "
        "a second, mirrored print of it there"
        for name in fins
    )
