#!/usr/bin/env python3
"""Writes docs/scenes.md, the reference of everything that a scene file may name, and src/compile/plugin_titles.inc.

    scripts/make_scene_docs.py                    write both
    scripts/make_scene_docs.py --check            say whether they are what would be written (exit status 1 if not)
    scripts/make_scene_docs.py --render PROGRAM   render the pictures too, with PROGRAM (build/release/norrsken)

Plugins are those of src/lists. Of each, the host file declares its parameters (src/scene/parameter.h), which the program
list_plugins (scripts/list_plugins.cpp; --plugins, build/release/list_plugins if not said) tells; the host file's block says
what else there is to know, the kernel header's block what its model and source are. Pictures are docs/plugin_scenes/FAMILY/NAME.xml, rendered to
docs/images/plugins/FAMILY_NAME.jpg; a plugin without such a scene has none.
"""
import argparse
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/scenes.md"
TITLES = ROOT / "src/compile/plugin_titles.inc"
PICTURES = ROOT / "docs/images/plugins"
SCENES = ROOT / "docs/plugin_scenes"
ENLARGED = ("rfilter", "sampler")  # families whose pictures are about single pixels

# Heading, folder, element of the scene file, lists (src/lists) that name its plugins, header with the block of the whole family.
FAMILIES = [
    ("Integrators", "integrator", "integrator", ["integrator"], "integrator_host.h"),
    ("Sensors", "camera", "sensor", ["camera", "meter", "sensor_adapter"], None),
    ("Films", "camera", "film", ["film"], None),
    ("Reconstruction filters", "rfilter", "rfilter", ["rfilter"], None),
    ("Samplers", "sampler", "sampler", ["sampler"], None),
    ("BSDFs", "bsdf", "bsdf", ["bsdf", "bsdf_resolved", "bsdf_adapter"], None),
    ("Textures", "texture", "texture", ["texture"], None),
    ("Media", "medium", "medium", ["medium"], None),
    ("Phase functions", "medium", "phase", ["phase", "phase_adapter"], None),
    ("Volumes", "medium", "volume", ["volume"], None),
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
    heading = ""

    def flush():
        if table:
            out.extend(["", f"| {heading} | |", "|---|---|"])
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
        elif not line or re.fullmatch(r"[A-Z][a-z]+", line):  # the heading of a table
            flush()
            heading = line.lower()
        else:
            if table:
                flush()
            if re.match(r"(Departures|Sources?|Side|Children)\b", line):
                flush()
            prose.append(line)
    flush()
    return "\n".join(out)


def title_and_body(folder, name):
    """What a plugin is, and the rest of its host file's block."""
    host = header_block(ROOT / f"src/{folder}/{name}.cpp")
    if not host:
        sys.exit(f"src/{folder}/{name}.cpp has no header block")
    title = re.sub(rf"^{name}: ?", "", host[0])
    body = host[1:]
    while body and body[0] and not re.match(r"(Departures|Sources?|Side|Children|Measure|Types)\b", body[0]):
        title += " " + body.pop(0)
    if title.rstrip(".") == "host side":
        title = fields(header_block(ROOT / f"src/{folder}/{name}.h")).get("Model", "")
    return title[:1].upper() + title[1:], body


def plain(number):
    return f"{number:.0f}" if number == int(number) and abs(number) < 1e7 else f"{number:g}"


def range_of(parameter):
    """In words; what only an integer's size bounds is no bound."""
    low, high = parameter["min"], parameter["max"]
    if parameter["type"] == "integer" and high is not None and high >= 2**31 - 2:
        high = None
    if low is not None and high is not None and parameter["min_belongs"]:
        return f"{plain(low)} to {plain(high)}"
    words = []
    if low is not None:
        words.append(("at least " if parameter["min_belongs"] else "above ") + plain(low))
    if high is not None:
        words.append(("at most " if parameter["max_belongs"] else "below ") + plain(high))
    return " and ".join(words)


def default_of(parameter):
    text = parameter["default"]
    if parameter["type"] == "transform" and not parameter["in_place_of"]:
        return "identity"
    if parameter["type"] in ("number", "color") and text:
        return f"{float(text):.4g}" if abs(float(text)) < 1e4 else plain(float(text))
    return f'"{text}"' if parameter["type"] == "string" and text else text


def row_text(parameter):
    """What a parameter is, in words: type, unit, range, default; then the text of its declaration."""
    if parameter["choices"]:
        words = [w + " (default)" if w == parameter["default"] else w for w in parameter["choices"]]
        text = ", ".join(words[:-1]) + " or " + words[-1]
    else:
        kind = parameter["type"]
        if parameter["texture"] and kind != "texture":
            kind += " or texture"
        if parameter["volume"]:
            kind += " or volume"
        clamped = "else clamped with a warning" if parameter["clamped"] and range_of(parameter) else ""
        text = ", ".join(filter(None, [kind, parameter["unit"], range_of(parameter), clamped]))
        default = default_of(parameter)
        text += f" (default {default})" if default else ""
    if parameter["required"]:
        text += ", required"
    if parameter["in_place_of"]:
        text += f", in place of `{parameter['in_place_of']}`"
    return text + (": " + parameter["text"] if parameter["text"] else "")


def parameter_table(parameters):
    """Neighbours that are the same in all but their names share a row."""
    out = ["", "| parameter | |", "|---|---|"]
    for text, group in itertools.groupby(parameters, row_text):
        names = ", ".join(f"`{parameter['name']}`" for parameter in group)
        out.append(f"| {names} | {cell(text)} |")
    return out if parameters else []


def plugin_section(folder, element, name, parameters):
    kernel = fields(header_block(ROOT / f"src/{folder}/{name}.h"))
    title, body = title_and_body(folder, name)
    out = [f"### {name}", "", cell(title)]
    picture = PICTURES / f"{'film' if element == 'film' else folder}_{name}.jpg"
    if picture.exists():
        out += ["", f"![{element} {name}](images/plugins/{picture.name})"]
    out += parameter_table(parameters)
    text = render_block(body)
    if text.strip():
        out.append(text)
    for key in ("Source", "Departures"):
        if key not in text and kernel.get(key, "none").rstrip(".") not in ("none", "none needed", "-", "the usual"):
            out += ["", f"{key}: {cell(kernel[key])}"]
    return "\n".join(out)


def literal(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def titles():
    """The table of src/compile/plugin_info.cpp."""
    out = ["// Written by scripts/make_scene_docs.py from the header blocks of the sources."]
    for _, folder, element, lists, _ in FAMILIES:
        out += [f'{{"{element}", "{name}", {literal(title_and_body(folder, name)[0])}}},' for name in plugin_names(lists)]
    return "\n".join(out) + "\n"


def without_effect():
    """The table of src/scene/base_parameters.cpp."""
    source = (ROOT / "src/scene/base_parameters.cpp").read_text()
    rows = re.findall(r'\{"(\w+)", "(\w*)", "(\w+)", Type::\w+, "(.*?)"\}', source)
    out = ["", "## Without effect", "",
           "These are parameters that Mitsuba's plugins take and that mean nothing here. They are taken, and named in a note.",
           "", "| of | parameter | instead |", "|---|---|---|"]
    return out + [f"| {plugin or 'every ' + kind} | `{name}` | {instead} |" for kind, plugin, name, instead in rows]


def page(plugins):
    """`plugins`: what list_plugins prints."""
    out = ["# Scene files: every plugin and its parameters", "",
           "Norrsken reads the XML format of Mitsuba 3, [scenes in pbrt's language](pbrt.md), and [glTF](gltf.md). This page is written by `scripts/make_scene_docs.py` from what the "
           "sources declare and their header blocks; change it there. Lengths are in scene units, angles in degrees, colours "
           "linear sRGB; \"color\" stands for `rgb`, `spectrum` or a grey `float`, \"number\" for `float` or `integer`. A "
           "parameter that nobody asks for is an error, but for [those](#without-effect) that the format's base classes take. "
           "A number that may be a texture may be a color too, whose mean counts."]
    families = [(heading, folder, element, plugin_names(lists), common)
                for heading, folder, element, lists, common in FAMILIES]
    out += [""] + [f"- **{heading}**: " + ", ".join(f"[{n}](#{n})" for n in names)
                   for heading, _, _, names, _ in families if names]
    for heading, folder, element, names, common in families:
        out += ["", f"## {heading}"]
        parameters = {name: next(p["parameters"] for p in plugins if (p["kind"], p["name"]) == (element, name))
                      for name in names}
        # What all plugins of a family have is told once.
        of_all = [p for p in parameters[names[0]] if len(names) > 1 and all(p in parameters[name] for name in names)]
        if common:
            block = header_block(ROOT / f"src/{folder}/{common}")
            out += ["", cell(block[0]), render_block(block[1:])]
        if of_all:
            out += ["", f"All {heading.lower()} have:"] + parameter_table(of_all)
        for name in names:
            out += ["", plugin_section(folder, element, name, [p for p in parameters[name] if p not in of_all])]
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
    parser.add_argument("--check", action="store_true", help="only say whether they are up to date")
    parser.add_argument("--render", metavar="PROGRAM", help="render the pictures with this program")
    parser.add_argument("--plugins", metavar="PROGRAM", default=ROOT / "build/release/list_plugins",
                        help="tells the parameters: list_plugins as it was built")
    arguments = parser.parse_args()
    if arguments.render:
        render(arguments.render)
    plugins = json.loads(subprocess.run([arguments.plugins], check=True, capture_output=True, text=True).stdout)
    for path, text in ((PAGE, page(plugins)), (TITLES, titles())):
        if not arguments.check:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            sys.exit(f"{path.relative_to(ROOT)} is not what the sources say: run scripts/make_scene_docs.py")
        else:
            print(f"{path.relative_to(ROOT)}: up to date")


if __name__ == "__main__":
    main()
