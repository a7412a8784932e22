"""Mechanisms from their parameters as design.json and wishes state them."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, get_type_hints

from popsim.errors import DesignError, GeometryError
from popsim.mechanisms.base import Mechanism
from popsim.mechanisms.pair import BasePatchPair
from popsim.mechanisms.registry import mechanism_type


def restored(type: str, parameters: Mapping[str, Any], pair: BasePatchPair, id: str) -> Mechanism:
    """Return the mechanism whose `parameters` these are: the inverse of :meth:`Mechanism.parameters`.

    Parameters
    ----------
    type:
        Its name in the registry.
    parameters:
        As JSON or YAML holds them; those with a default, or that follow from others, may be missing.
    pair, id:
        Where it stands, and what it is called.

    Raises
    ------
    DesignError
        There is no such mechanism, or a parameter is missing, unknown or no such value.
    GeometryError
        The values are no such mechanism.
    """
    from pydantic import TypeAdapter, ValidationError

    kind = mechanism_type(type)
    hints = get_type_hints(kind)
    own = {field.name: field for field in fields(kind) if field.name not in ("id", "pair")}
    if unknown := sorted(set(parameters) - set(own)):
        raise DesignError(f"{id}: a {type} has no parameter '{unknown[0]}'; it has {', '.join(own)}")
    values: dict[str, Any] = {}
    for name, value in parameters.items():
        try:
            values[name] = TypeAdapter(hints[name]).validate_python(value)
        except ValidationError as error:
            problem = error.errors()[0]["msg"]
            raise DesignError(f"{id}: parameter '{name}' of a {type}: {problem}; found {value!r}") from None
    try:
        return kind(id, pair, **{**kind.derived(values), **values})
    except TypeError:
        missing = [name for name in own if name not in {**kind.derived(values), **values}]
        raise DesignError(f"{id}: a {type} needs the parameters {', '.join(own)}; missing: {missing[0]}") from None


def essential(mechanism: Mechanism) -> dict[str, Any]:
    """Return the parameters of a mechanism that do not follow from the others."""
    found = mechanism.parameters()
    for name in list(found):
        rest = {key: value for key, value in found.items() if key != name}
        try:
            alike = restored(mechanism.type, rest, mechanism.pair, mechanism.id) == mechanism
        except (DesignError, GeometryError):
            continue
        found = rest if alike else found
    return found
