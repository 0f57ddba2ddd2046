"""Data of a report as the page reads it, made in Python: a second implementation of what master/report writes."""

import base64
import json
import struct
import zlib

FORMATS = {"float64": "d", "int64": "q", "int32": "i", "uint8": "B"}
MARK = "<!-- stride:data -->"


def pack(kind, values):
    """An array: its elements little-endian, their bytes transposed, deflated without a header, in base64."""
    values = list(values)
    plain = struct.pack(f"<{len(values)}{FORMATS[kind]}", *values)
    width = struct.calcsize(f"<{FORMATS[kind]}")
    transposed = b"".join(plain[k::width] for k in range(width))
    deflater = zlib.compressobj(6, zlib.DEFLATED, -15)
    data = deflater.compress(transposed) + deflater.flush()
    return {"type": kind, "count": len(values), "data": base64.b64encode(data).decode()}


def pack_strings(texts):
    distinct = list(dict.fromkeys(texts))
    index = {text: i for i, text in enumerate(distinct)}
    return {"type": "strings", "values": distinct, "indices": pack("int32", [index[text] for text in texts])}


def column(name, values, unit="", kind="Float64", stepped=None):
    kinds = {"Float64": "float64", "Float32": "float64", "Boolean": "uint8", "Int32": "int32"}
    packed = pack_strings(values) if kind == "String" else pack(kinds[kind], values)
    is_stepped = kind != "Float64" if stepped is None else stepped
    return {"name": name, "unit": unit, "type": kind, "stepped": is_stepped, "values": packed}


def pack_texts(texts):
    """Texts one after the other, a 0 behind each."""
    texts = list(texts)
    return {"type": "texts", "count": len(texts), "bytes": pack("uint8", b"".join(t.encode() + b"\0" for t in texts))}


def activity(component, kind, intervals):
    return {"component": component, "kind": kind, "from": pack("int64", [a for a, _ in intervals]),
            "until": pack("int64", [b for _, b in intervals])}


def report(times, columns, plots, **parts):
    """The whole object; `times` in picoseconds."""
    data = {"format": 1, "stride": "test", "run": {}, "time": pack("int64", times), "rows": len(times),
            "columns": columns,
            "plots": [{"title": title, "signals": signals} for title, signals in plots],
            "messages": [], "activity": [], "films": [], "diagram": {"components": [], "connections": []}}
    data.update(parts)
    return data


def write_page(page, data, path):
    """Puts the data into the page."""
    text = json.dumps(data, ensure_ascii=False).replace("<", "\\u003c")
    script = f'<script type="application/json" id="stride-report">{text}</script>'
    empty = page.read_text(encoding="utf-8")
    if empty.count(MARK) != 1:
        raise ValueError(f"{page}: expected '{MARK}' once")
    path.write_text(empty.replace(MARK, script), encoding="utf-8")
