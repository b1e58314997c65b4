#!/usr/bin/env python3
"""Sends the document or the selection to a running plotwright server, for Inkscape's menu Extensions, Export.

Inkscape calls it with the options of plotwright.inx, --id=ID for each selected object, and the document as a file, and
shows what it writes to stderr. It needs nothing but Python 3.7. It writes no document, so the drawing stays as it is.
"""
import argparse
import ipaddress
import json
import re
import sys
import urllib.error
import urllib.parse
import urllib.request
import webbrowser
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
SODIPODI = "{http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd}"
TIMEOUT_S = 120


class Problem(Exception):
    """What is wrong, in words for the user."""


def main(arguments):
    options = options_in(arguments)
    server = Server(options.server, options.key)
    tree = read(options.file)
    if options.what == "selection":
        keep_selection(tree.getroot(), options.id)
    plotter = server.plotter(options.plotter)
    fields = {"name": name_of(tree.getroot()), "plotterId": plotter["id"]}
    pens = server.ask("GET", "/plotters/%s/defaults" % plotter["id"])["settings"]["pens"]
    layer_pens = pens_by_layer(tree.getroot(), pens)
    if layer_pens:
        fields["settings"] = json.dumps({"layerPens": layer_pens})
    body = ElementTree.tostring(tree.getroot(), encoding="utf-8", xml_declaration=True)
    job = server.ask("POST", "/jobs?" + urllib.parse.urlencode(fields), body)
    if options.then == "start":
        server.ask("POST", "/jobs/%s/start" % job["id"])
    if options.then == "page":
        webbrowser.open(server.url)
    return told(job, plotter, options.then)


def options_in(arguments):
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--what", choices=["document", "selection"], default="document")
    parser.add_argument("--then", choices=["queue", "page", "start"], default="queue")
    parser.add_argument("--server", default="http://127.0.0.1:9080")
    parser.add_argument("--key", default="")
    parser.add_argument("--plotter", default="")
    parser.add_argument("--id", action="append", default=[])
    parser.add_argument("file")
    # Inkscape also gives the tab that was open, and the selected nodes.
    return parser.parse_known_args(arguments)[0]


def read(file):
    # Otherwise the names of the namespaces would be ns0, ns1 … in what is sent.
    for _, (prefix, uri) in ElementTree.iterparse(file, events=["start-ns"]):
        if not re.match(r"ns\d+$", prefix):
            ElementTree.register_namespace(prefix, uri)
    return ElementTree.parse(file)


def keep_selection(root, ids):
    """Moves everything else into <defs>: it is not drawn, but clones and clips that refer to it stay whole."""
    selected = {element for element in root.iter() if element.get("id") in ids}
    if not selected:
        raise Problem("Nothing is selected. Select what is to be plotted, or send the whole document.")
    parents = {child: parent for parent in root.iter() for child in parent}
    kept = set()
    for element in selected:
        kept.update(element.iter())
        while element is not None:
            kept.add(element)
            element = parents.get(element)
    rest = ElementTree.Element(SVG + "defs")
    for parent, child in [(parent, child) for child, parent in parents.items()]:
        if parent in kept and child not in kept and is_drawn(child):
            parent.remove(child)
            rest.append(child)
    root.insert(0, rest)


def is_drawn(element):
    return isinstance(element.tag, str) and element.tag.startswith(SVG) and element.tag[len(SVG) :] not in (
        "defs",
        "style",
        "title",
        "desc",
        "metadata",
    )


def name_of(root):
    name = root.get(SODIPODI + "docname", "").strip()
    return name[:200] or "drawing.svg"


def pens_by_layer(root, pens):
    """The ids of pens by the ids of layers, where a layer has a pen's name, also after a number: "2 Blue"."""
    by_name = {pen["name"].strip().lower(): pen["id"] for pen in pens}
    chosen = {}
    for group in root.iter(SVG + "g"):
        if group.get(INKSCAPE + "groupmode") != "layer" or group.get("id") is None:
            continue
        label = group.get(INKSCAPE + "label", "").strip().lower()
        pen = by_name.get(label) or by_name.get(re.sub(r"^\d+[\s.:_-]*", "", label))
        if pen is not None:
            chosen[group.get("id")] = pen
    return chosen


class Server:
    def __init__(self, url, key):
        self.url = url.strip().rstrip("/")
        parts = urllib.parse.urlsplit(self.url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise Problem("%s is not an address. It is written like http://127.0.0.1:9080." % url)
        self.key = key.strip()
        # A proxy cannot reach this computer.
        proxies = {} if is_this_computer(parts.hostname) else None
        self.opener = urllib.request.build_opener(urllib.request.ProxyHandler(proxies))

    def ask(self, method, path, body=None):
        headers = {"Content-Type": "application/octet-stream"} if body is not None else {}
        if self.key:
            headers["Authorization"] = "Bearer " + self.key
        request = urllib.request.Request(self.url + "/api/v1" + path, body, headers, method=method)
        try:
            with self.opener.open(request, timeout=TIMEOUT_S) as answer:
                return json.load(answer)
        except urllib.error.HTTPError as error:
            raise Problem(reason(error))
        except (OSError, ValueError):
            raise Problem(
                "No plotwright server answers at %s. Start it with: plotwright serve. "
                "Or set its address on the tab Server." % self.url
            )

    def plotter(self, wanted):
        plotters = self.ask("GET", "/state")["plotters"]
        name = wanted.strip().lower()
        for plotter in plotters:
            if name in ("", plotter["id"].lower(), plotter["name"].lower()):
                return plotter
        names = ", ".join(plotter["name"] for plotter in plotters)
        raise Problem("There is no plotter %s. There is %s." % (wanted, names))


def is_this_computer(host):
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def reason(error):
    try:
        return json.load(error)["error"]["message"]
    except (ValueError, KeyError, TypeError):
        return "The server answered %d. Is it a plotwright server?" % error.code


def told(job, plotter, then):
    size = job["stats"]["size"]
    seconds = round(job["expectedS"] or job["stats"]["durationS"])
    state = "is plotted on" if then == "start" else "is in the queue of"
    lines = [
        "%s %s %s: %d × %d mm, %d:%02d minutes."
        % (
            job["name"],
            state,
            plotter["name"],
            round(size["widthMm"]),
            round(size["heightMm"]),
            seconds // 60,
            seconds % 60,
        )
    ]
    lines += ["Note: %s" % warning for warning in job["warnings"]]
    return "\n".join(lines)


if __name__ == "__main__":
    # Windows' own encoding lacks some characters of names.
    sys.stderr.reconfigure(encoding="utf-8", errors="replace")
    try:
        print(main(sys.argv[1:]), file=sys.stderr)
    except Problem as problem:
        print("plotwright: %s" % problem, file=sys.stderr)
        sys.exit(1)
