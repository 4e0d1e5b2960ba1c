from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._callbacks import CallbackGuard, Progress
from pt._columns import Array, column_of, sphere_column
from pt._enums import MaterialFlag
from pt._vectors import Color, Vector, color, vector


@dataclass(frozen=True)
class Material:
    """The physically normalised Phong model of pt/pt.h. A color is linear R, G, B, each in [0, 1e18], or one number.

    diffuse      fraction of the light that is reflected diffusely
    specular     weight of the lobe about the mirror direction
    emission     radiance, in every direction and on both sides
    glossiness   exponent of the lobe, in [0, 1e9]
    hidden_from_camera   whether camera rays pass through, and no other rays
    """

    diffuse: Color = 0.0
    specular: Color = 0.0
    emission: Color = 0.0
    glossiness: float = 0.0
    hidden_from_camera: bool = False

    def __post_init__(self) -> None:
        for name in ("diffuse", "specular", "emission"):
            object.__setattr__(self, name, color(name, getattr(self, name)))
        object.__setattr__(self, "glossiness", float(self.glossiness))

    def _section(self) -> dict[str, Any]:
        section: dict[str, Any] = {}
        for name in ("diffuse", "specular", "emission", "glossiness", "hidden_from_camera"):
            value = getattr(self, name)
            if value not in (0.0, False, (0.0, 0.0, 0.0)):
                section[name] = value[0] if isinstance(value, tuple) and len(set(value)) == 1 else value
        return section

    def _struct(self) -> structs.pt_material:
        return structs.pt_material(self.diffuse, self.specular, self.emission, self.glossiness,
                                   MaterialFlag.HIDDEN_FROM_CAMERA if self.hidden_from_camera else 0)


MaterialOrIndex: TypeAlias = "Material | int"


@dataclass(frozen=True)
class Sphere:
    """A ball. Both sides are visible, reflect and emit.

    center     at time 0
    radius     > 0
    material   a Material, or an index in Scene.materials
    motion     displacement from time 0 to time 1
    """

    center: Vector
    radius: float
    material: MaterialOrIndex
    motion: Vector = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector("center", self.center))
        object.__setattr__(self, "radius", float(self.radius))
        object.__setattr__(self, "motion", vector("motion", self.motion))


@dataclass(frozen=True)
class Plane:
    """The points x with dot(normal, x) + offset = 0. Both sides are visible, reflect and emit.

    normal     any length except 0, by which normal and offset are divided
    material   a Material, or an index in Scene.materials
    """

    normal: Vector
    offset: float
    material: MaterialOrIndex

    def __post_init__(self) -> None:
        object.__setattr__(self, "normal", vector("normal", self.normal))
        object.__setattr__(self, "offset", float(self.offset))


class SphereArray:
    """Many spheres from NumPy arrays, which each set_scene reads anew.

    center     shape (n, 3), at time 0
    radius     shape (n,), or one number for all; > 0
    material   a Material or an index in Scene.materials for all, or indices of shape (n,)
    motion     shape (n, 3) or (3,): displacement from time 0 to time 1
    color      shape (n, 3) or (3,): linear floats in [0, 1], or sRGB in uint8; multiplies the material's diffuse
    end        shape (n, 3) or (3,): the other center of a capsule, which neither emits nor moves
    opacity    shape (n,), or one number for all, in [0, 1]: probability that a ray hits the sphere

    Native float32, float64, uint32 (indices) and uint8 (colors) are read in place if each row is contiguous and rows
    ascend at any stride, such as a[::2] and a[:, :3]. The constructor copies other arrays; `copied` has their names.
    Raises ValueError for unsuitable shapes, TypeError for unsuitable types.
    """

    center: Array
    radius: Array
    material: Material | Array
    motion: Array | None
    color: Array | None
    end: Array | None
    opacity: Array | None

    def __init__(self, center: npt.ArrayLike, radius: npt.ArrayLike, material: MaterialOrIndex | npt.ArrayLike, *,
                 motion: npt.ArrayLike | None = None, color: npt.ArrayLike | None = None,
                 end: npt.ArrayLike | None = None, opacity: npt.ArrayLike | None = None) -> None:
        given = {"center": center, "radius": radius, "material": material, "motion": motion, "color": color,
                 "end": end, "opacity": opacity}
        for name, values in given.items():
            count = None if name == "center" else len(self.center)
            setattr(self, name, values if values is None or isinstance(values, Material)
                    else sphere_column(name, values, count))
        self.copied: tuple[str, ...] = tuple(name for name, value in given.items() if self._is_copy(name, value))

    def _is_copy(self, name: str, value: object) -> bool:
        column = getattr(self, name)
        return (isinstance(column, np.ndarray) and column.size > 0 and
                not (isinstance(value, np.ndarray) and np.may_share_memory(column, value)))

    def __len__(self) -> int:
        return len(self.center)

    def __repr__(self) -> str:
        return f"<pt.SphereArray of {len(self)} spheres>"


@dataclass
class Scene:
    """materials       list for indices; materials of spheres and planes are appended, each once
    sphere_arrays   more spheres, for instance a SphereArray of each species
    """

    spheres: Sequence[Sphere] = ()
    planes: Sequence[Plane] = ()
    sphere_arrays: Sequence[SphereArray] = ()
    materials: Sequence[Material] = field(default=(), kw_only=True)


class _Materials:
    def __init__(self, listed: Sequence[Material]) -> None:
        self.all = list(listed)
        self.indices: dict[Material, int] = {}
        for index, material in enumerate(listed):
            self.indices.setdefault(material, index)

    def index(self, material: MaterialOrIndex) -> int:
        if not isinstance(material, Material):
            index = operator.index(material)
            if not 0 <= index < 2**32:
                raise ValueError(f"material = {index}: must be a Material or an index of Scene.materials")
            return index
        if material not in self.indices:
            self.indices[material] = len(self.all)
            self.all.append(material)
        return self.indices[material]


class SceneStruct:
    """A pt_scene. Its arrays live as long as this object."""

    def __init__(self, scene: Scene, guard: CallbackGuard, progress: Progress | None) -> None:
        materials = _Materials(scene.materials)
        spheres = [structs.pt_sphere(s.center, s.radius, s.motion, materials.index(s.material)) for s in scene.spheres]
        planes = [structs.pt_plane(p.normal, p.offset, materials.index(p.material)) for p in scene.planes]
        self._columns: list[Array] = []
        arrays = [self._sphere_array(array, materials) for array in scene.sphere_arrays]
        self.struct = structs.pt_scene(
            material_count=len(materials.all),
            materials=_pointer(structs.pt_material, [material._struct() for material in materials.all]),
            sphere_count=len(spheres), spheres=_pointer(structs.pt_sphere, spheres), plane_count=len(planes),
            planes=_pointer(structs.pt_plane, planes), sphere_array_count=len(arrays),
            sphere_arrays=_pointer(structs.pt_sphere_array, arrays), progress=guard.progress(progress))

    def _sphere_array(self, array: SphereArray, materials: _Materials) -> structs.pt_sphere_array:
        columns: dict[str, Array | None] = {name: getattr(array, name) for name in structs.SPHERE_COLUMNS}
        if isinstance(array.material, Material):
            columns["material"] = np.broadcast_to(np.uint32(materials.index(array.material)), len(array))
        self._columns += [column for column in columns.values() if column is not None]
        return structs.pt_sphere_array(count=len(array), **{name: column_of(each) for name, each in columns.items()})


def _pointer(struct: Any, elements: list[Any]) -> Any:
    return (struct * len(elements))(*elements) if elements else None

