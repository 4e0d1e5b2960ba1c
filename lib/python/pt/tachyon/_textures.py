from __future__ import annotations

from pt._scene import Material
from pt.tachyon._words import Words

MIRROR_GLOSSINESS = 1e6  # for perfect mirrors; the lobe is narrower than most pixels
# Arguments of TEXFUNC's patterns 0 to 10: whether there is a file name, and the names of vectors.
PLACE = ("CENTER", "ROTATE", "SCALE")
PATTERNS: tuple[tuple[bool, tuple[str, ...]], ...] = (
    ((False, ()),) + 6 * ((False, PLACE),) + 2 * ((True, PLACE),) +
    ((True, PLACE + ("UAXIS", "VAXIS")), (True, PLACE + ("UAXIS", "VAXIS", "WAXIS"))))


class Textures:
    def __init__(self, words: Words, left_out: dict[str, str]) -> None:
        self._words = words
        self._left_out = left_out
        self._named: dict[str, int] = {}
        self._indices: dict[Material, int] = {}
        self.materials: list[Material] = []

    def define(self) -> None:
        name = self._words.word("the name of a TEXDEF")
        self._named[name] = self._body()

    def define_alias(self) -> None:
        name = self._words.word("the name of a TEXALIAS")
        self._named[name] = self._find(self._words.word("the name of a texture"))

    def reference(self) -> int:
        name = self._words.word("a texture")
        return self._body() if name.upper() == "TEXTURE" else self._find(name)

    def _find(self, name: str) -> int:
        if name not in self._named:
            self._words.refuse(f'"{name}": must be TEXTURE or the name of a TEXDEF before it')
        return self._named[name]

    def _leave_out(self, keyword: str, what: str) -> None:
        self._left_out.setdefault(keyword, f"{self._words.place()}: {keyword}: {what}")

    def _body(self) -> int:
        words = self._words
        words.named("AMBIENT", least=0.0)
        diffuse = words.named("DIFFUSE", least=0.0)
        mirror = words.named("SPECULAR", least=0.0)
        if words.named("OPACITY", least=0.0) < 1.0:
            self._leave_out("OPACITY", "transparency is left out, so surfaces are opaque")
        if words.take_if("TRANSMODE"):
            words.word("the kind of transparency")
        if words.take_if("OUTLINE"):
            if words.number("OUTLINE") != 0.0:
                self._leave_out("OUTLINE", "outlines are left out")
            words.named("OUTLINE_WIDTH")
        highlight, exponent, is_metal = 0.0, 0.0, False
        if words.take_if("PHONG"):
            is_metal = words.keyword("PLASTIC or METAL") == "METAL"
            highlight = words.number("PHONG", least=0.0)
            exponent = words.named("PHONG_SIZE", least=0.0)
        words.expect("COLOR")
        color = words.color("COLOR")
        self._skip_pattern()
        if mirror > 0.0:
            specular, exponent = (mirror, mirror, mirror), MIRROR_GLOSSINESS
        else:  # Tachyon states the peak, which is (n + 2) / 2 times the lobe's weight
            weight = 2.0 * highlight / (exponent + 2.0)
            red, green, blue = color if is_metal else (1.0, 1.0, 1.0)
            specular = (weight * red, weight * green, weight * blue)
        material = Material(diffuse=(diffuse * color[0], diffuse * color[1], diffuse * color[2]), specular=specular,
                            glossiness=exponent if any(specular) else 0.0)
        index = self._indices.setdefault(material, len(self.materials))
        if index == len(self.materials):
            self.materials.append(material)
        return index

    def _skip_pattern(self) -> None:
        number = self._words.named("TEXFUNC")
        if number not in range(len(PATTERNS)):
            self._words.refuse("TEXFUNC: must be a whole number from 0 to 10")
        has_file, vectors = PATTERNS[int(number)]
        if number:
            self._leave_out("TEXFUNC", "patterns and images on surfaces are left out, so they have their plain color")
        if has_file:
            self._words.word("the name of an image")
        for keyword in vectors:
            self._words.vector(keyword)
