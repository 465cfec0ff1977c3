#!/usr/bin/env python3
"""Writes docs/scenes.md, the reference of everything that a scene file may name, from the sources' own header blocks.

    scripts/make_scene_docs.py                    write docs/scenes.md and src/compile/plugin_texts.inc
    scripts/make_scene_docs.py --check            say whether they are what would be written (exit status 1 if not)
    scripts/make_scene_docs.py --render PROGRAM   render the pictures too, with PROGRAM (build/release/norrsken)

Plugins are those of src/lists. Of each, the host file's block says what its parameters are,
the kernel header's block what its model and source are. Pictures are docs/plugin_scenes/FAMILY/NAME.xml, rendered to
docs/images/plugins/FAMILY_NAME.jpg; a plugin without such a scene has none.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/scenes.md"
TEXTS = ROOT / "src/compile/plugin_texts.inc"
PICTURES = ROOT / "docs/images/plugins"
SCENES = ROOT / "docs/plugin_scenes"
ENLARGED = ("rfilter", "sampler")  # families whose pictures are about single pixels

# Heading, folder, element of the scene file, lists (src/lists) that name its plugins, header with the parameters of the whole family.
FAMILIES = [
    ("Integrators", "integrator", "integrator", ["integrator"], "integrator_host.h"),
    ("Sensors", "camera", "sensor", ["camera"], None),
    ("Films", "camera", "film", ["film"], None),
    ("Reconstruction filters", "rfilter", "rfilter", ["rfilter"], None),
    ("Samplers", "sampler", "sampler", ["sampler"], "sampler_host.h"),
    ("BSDFs", "bsdf", "bsdf", ["bsdf", "bsdf_resolved", "bsdf_adapter"], None),
    ("Textures", "texture", "texture", ["texture"], None),
    ("Emitters", "light", "emitter", ["emitter"], "light_host.h"),
    ("Shapes", "shape", "shape", ["shape"], "mesh_host.h"),
]


def header_block(path):
    """The lines of the comment that a file begins with, without their slashes."""
    lines = []
    if path.exists():
        for line in path.read_text().splitlines():
            if not line.startswith("//"):
                break
            lines.append(line[2:].removeprefix(" ").rstrip())
    return lines


def plugin_names(lists):
    names = set()
    for name in lists:
        names.update(re.findall(r"^NORRSKEN_\w+\((\w+)", (ROOT / f"src/lists/{name}.def").read_text(), re.MULTILINE))
    return sorted(names)


def fields(block):
    """Of a kernel header: 'Model', 'Source', ... and their texts."""
    result, current = {}, None
    for line in block:
        match = re.match(r"([A-Z][a-z]+) {2,}(\S.*)", line)
        if match:
            current = match[1]
            result[current] = match[2]
        elif current and line.startswith("   "):
            result[current] += " " + line.strip()
        else:
            current = None
    return result


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;").replace(">", "&gt;").replace("&lt;br&gt;", "<br>")


def sentences(lines):
    return cell(" ".join(lines).replace("  ", " ").strip())


def render_block(block):
    """Prose and tables of a host file's block, without its first line."""
    out, table, prose = [], [], []

    def flush():
        if table:
            out.extend(["", "| parameter | |", "|---|---|"])
            out.extend(f"| {cell(name)} | {cell(text)} |" for name, text in table)
            table.clear()
        if prose:
            out.extend(["", sentences(prose)])
            prose.clear()

    column = 0  # where the text of the last entry begins
    for line in block:
        entry = re.match(r"  (\S.*?)(?: {2,}|$)(.*)", line)
        if line.startswith("   ") and table:
            more = line.strip()
            if not table[-1][1]:
                column = line.index(more)
            elif line.index(more) > column:  # a list within the text, of things and what they are
                item = re.match(r"(\S.*?) {2,}(.*)", more)
                more = f"<br>`{item[1]}` " + re.sub(" {2,}", ": ", item[2]) if item else more
            table[-1][1] = (table[-1][1] + " " + more).strip()
        elif entry:
            if prose:
                flush()
            names = ", ".join(f"`{n.strip()}`" for n in entry[1].split(",") if n.strip())
            if table and not table[-1][1]:  # the names took more than a line
                table[-1][0] += ", " + names
                table[-1][1] = entry[2]
            else:
                table.append([names, entry[2]])
            column = entry.start(2)
        elif not line or line in ("Parameters", "Children") or line.startswith("Parameters of "):
            flush()
        else:
            if table:
                flush()
            # What the host stores is between it and the kernel.
            if re.match(r"(Departures|Sources?|Side|Children|Stored)\b", line):
                flush()
            prose.append(line)
    flush()
    text = "\n".join(out)
    text = re.sub(r"\n\nStored:[^\n]*", "", text)
    return re.sub(r"\((\w+)/\w+_host\.h\)", "(see the top of this section)", text)


def plugin_section(folder, element, name):
    host = header_block(ROOT / f"src/{folder}/{name}.cpp")
    kernel = fields(header_block(ROOT / f"src/{folder}/{name}.h"))
    if not host:
        sys.exit(f"src/{folder}/{name}.cpp has no header block")
    title = re.sub(rf"^{name}: ?", "", host[0])
    body = host[1:]
    while body and body[0] and not body[0].startswith("Parameters"):
        title += " " + body.pop(0)
    if title.rstrip(".") == "host side":
        title = kernel.get("Model", "")
    out = [f"### {name}", "", cell(title[:1].upper() + title[1:])]
    picture = PICTURES / f"{'film' if element == 'film' else folder}_{name}.jpg"
    if picture.exists():
        out += ["", f"![{element} {name}](images/plugins/{picture.name})"]
    text = render_block(body)
    if text.strip():
        out.append(text)
    for key in ("Source", "Departures"):
        if key not in text and kernel.get(key, "none").rstrip(".") not in ("none", "none needed", "-", "the usual"):
            out += ["", f"{key}: {cell(kernel[key])}"]
    return "\n".join(out)


UNIT = re.compile(r"\b(degrees|pixels|scene units|kelvin|nm)\b")


def title_and_body(folder, name):
    """What a plugin is, and the rest of its host file's block."""
    host = header_block(ROOT / f"src/{folder}/{name}.cpp")
    title = re.sub(rf"^{name}: ?", "", host[0])
    body = host[1:]
    while body and body[0] and not body[0].startswith("Parameters"):
        title += " " + body.pop(0)
    if title.rstrip(".") == "host side":
        title = fields(header_block(ROOT / f"src/{folder}/{name}.h")).get("Model", "")
    return title, body


def parameter_texts(block):
    """Parameters of a block and their texts."""
    table, names, inside = {}, [], False
    for line in block:
        entry = re.match(r"  (\S.*?)(?: {2,}|$)(.*)", line)
        if line.startswith("Parameters"):
            inside = True
        elif not line.startswith("  "):
            inside = False
        elif inside and line.startswith("   ") and names:
            for name in names:
                table[name] = (table[name] + " " + line.strip()).strip()
        elif inside and entry:
            more = [name.strip() for name in entry[1].split(",") if name.strip()]
            names = names + more if names and not table[names[0]] else more
            for name in names:
                table[name] = entry[2]
    return {name: re.sub(" {2,}", " ", text) for name, text in table.items()}


def literal(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def texts():
    """The table of src/compile/plugin_info.cpp."""
    out = ["// Written by scripts/make_scene_docs.py from the header blocks of the sources."]
    for _, folder, element, lists, common in FAMILIES:
        shared = parameter_texts(header_block(ROOT / f"src/{folder}/{common}")) if common else {}
        for name in plugin_names(lists):
            title, body = title_and_body(folder, name)
            parameters = {**shared, **parameter_texts(body)}
            out.append(f'{{"{element}", "{name}", "", "", {literal(title[:1].upper() + title[1:])}}},')
            for parameter, text in parameters.items():
                unit = None if text.startswith("string") else UNIT.search(text.split(":")[0])
                out.append(f'{{"{element}", "{name}", "{parameter}", "{unit[1] if unit else ""}", {literal(text)}}},')
    return "\n".join(out) + "\n"


def without_effect():
    """The table of src/scene/base_parameters.cpp."""
    source = (ROOT / "src/scene/base_parameters.cpp").read_text()
    rows = re.findall(r'\{"(\w+)", "(\w*)", "(\w+)", Type::\w+, "(.*?)"\}', source)
    out = ["", "## Without effect", "",
           "These are parameters that Mitsuba's plugins take and that mean nothing here. They are taken, and named in a note.",
           "", "| of | parameter | instead |", "|---|---|---|"]
    return out + [f"| {plugin or 'every ' + kind} | `{name}` | {instead} |" for kind, plugin, name, instead in rows]


def page():
    out = ["# Scene files: every plugin and its parameters", "",
           "Norrsken reads the XML format of Mitsuba 3, and [scenes in pbrt's language](pbrt.md). This page is written by `scripts/make_scene_docs.py` from the header "
           "blocks of the sources; change it there. Lengths are in scene units, angles in degrees, colours linear sRGB; "
           "\"color\" stands for `rgb`, `spectrum` or a grey `float`. A parameter that nobody asks for is an "
           "error, but for [those](#without-effect) that the format's base classes take. A number that may be a texture may "
           "be a color too, whose mean counts."]
    families = [(heading, folder, element, plugin_names(lists), common)
                for heading, folder, element, lists, common in FAMILIES]
    out += [""] + [f"- **{heading}**: " + ", ".join(f"[{n}](#{n})" for n in names)
                   for heading, _, _, names, _ in families if names]
    for heading, folder, element, names, common in families:
        if not names:
            continue
        out += ["", f"## {heading}"]
        if common:
            block = header_block(ROOT / f"src/{folder}/{common}")
            out += ["", cell(block[0]), render_block(block[1:]).strip("\n") and render_block(block[1:])]
        for name in names:
            out += ["", plugin_section(folder, element, name)]
    out += without_effect()
    return re.sub(r"\n{3,}", "\n\n", "\n".join(out)) + "\n"


def render(program):
    PICTURES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for scene in sorted(SCENES.glob("*/*.xml")):
            image = PICTURES / f"{scene.parent.name}_{scene.stem}.jpg"
            enlarged = scene.parent.name in ENLARGED
            first = pathlib.Path(folder) / "pixels.exr" if enlarged else image
            subprocess.run([program, "render", str(scene), "-o", str(first), "--quiet"], check=True)
            if enlarged:
                subprocess.run([program, "render", str(SCENES / "enlarge.xml"), f"-Dimage={first}", "-o", str(image),
                                "--quiet"], check=True)
            print(image.relative_to(ROOT))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only say whether docs/scenes.md is up to date")
    parser.add_argument("--render", metavar="PROGRAM", help="render the pictures with this program")
    arguments = parser.parse_args()
    if arguments.render:
        render(arguments.render)
    for path, text in ((PAGE, page()), (TEXTS, texts())):
        if not arguments.check:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            sys.exit(f"{path.relative_to(ROOT)} is not what the sources say: run scripts/make_scene_docs.py")
        else:
            print(f"{path.relative_to(ROOT)}: up to date")


if __name__ == "__main__":
    main()
