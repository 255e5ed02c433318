"""The program's functions (cpp/contct/serve/serve.h) in a page of a browser without a window."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "browser"))
from devtools import Browser  # noqa: E402

HARNESS = """<!DOCTYPE html>
<meta charset="utf-8">
<title>harness</title>
<script src="%s"></script>
<script>
const ready = contct_module();
// Calls one function with texts or null; its answer as text.
async function call(name, ...texts) {
  const m = await ready;
  const places = texts.map(text => {
    if (text === null) return 0;
    const length = m.lengthBytesUTF8(text) + 1, place = m._malloc(length);
    m.stringToUTF8(text, place, length);
    return place;
  });
  const answer = m["_contct_" + name](...places);
  const text = m.UTF8ToString(answer);
  m._contct_free(answer);
  places.forEach(place => m._free(place));
  return text;
}
// Milliseconds of each of so many calls.
async function times(count, name, ...texts) {
  const took = [];
  for (let i = 0; i < count; ++i) {
    const began = performance.now();
    await call(name, ...texts);
    took.push(performance.now() - began);
  }
  return took;
}
</script>
"""


class WasmPage:
    """`module`: contct.js, with its WebAssembly inside. The page that loads it is written to `work`."""

    def __init__(self, module, work):
        page = os.path.join(work, "harness.html")
        with open(page, "w", encoding="utf-8") as out:
            out.write(HARNESS % ("file://" + os.path.abspath(module)))
        self.browser = Browser()
        self.browser.open(page)

    def close(self):
        self.browser.close()

    def call(self, name, *texts):
        """The answer of contct_NAME to texts, None and dicts (options), as the object that it is."""
        return json.loads(self.browser.value(f"call({arguments(name, *texts)})"))

    def times(self, count, name, *texts):
        return self.browser.value(f"times({count}, {arguments(name, *texts)})")


def arguments(*texts):
    return ", ".join(json.dumps(json.dumps(t) if isinstance(t, dict) else t) for t in texts)
