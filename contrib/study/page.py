"""A page of HTML that needs no other file and no network."""
import base64
import html
import io
import os

from study.look import plt

STYLE = """
body { font: 16px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 80rem; padding: 0 1rem 3rem; color: #1a1a1a;
       background: #fff; }
h1 { font-size: 1.6rem; } h2 { border-bottom: 2px solid #0072B2; margin-top: 2.5rem; } h3 { margin-top: 1.8rem; }
nav { display: flex; flex-wrap: wrap; gap: .3rem 1.2rem; }
.wide { overflow-x: auto; } figure { margin: 1rem 0; } figure img { max-width: 100%; height: auto; }
figcaption, .note { color: #444; font-size: .9rem; }
table { border-collapse: collapse; font-size: .82rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .6rem; text-align: left; vertical-align: top; border-bottom: 1px solid #ddd; }
th { background: #f1f4f7; } th:first-child, td:first-child { min-width: 8rem; }
td.failed { background: #fbe9df; min-width: 18rem; }
pre { background: #f6f6f6; padding: .6rem; overflow-x: auto; font-size: .8rem; }
"""


class Page:
    def __init__(self, title, folder):
        """Pictures are embedded, and written into the folder, which is there, as PNG and SVG."""
        self.title, self.folder, self.parts, self.sections = title, folder, [], []

    def section(self, name, heading):
        self.sections.append((name, heading))
        self.parts.append(f'<h2 id="{name}">{html.escape(heading)}</h2>')

    def heading(self, text):
        self.parts.append(f"<h3>{html.escape(text)}</h3>")

    def text(self, text, note=False):
        self.parts.append(f"<p{' class=note' if note else ''}>{html.escape(text)}</p>")

    def items(self, texts):
        self.parts.append("<ul>" + "".join(f"<li>{html.escape(t)}</li>" for t in texts) + "</ul>")

    def code(self, text):
        self.parts.append(f"<pre>{html.escape(text)}</pre>")

    def table(self, header, rows):
        def cell(text):
            mark = " class=failed" if str(text).startswith("FAILED") else ""
            return f"<td{mark}>{html.escape(str(text))}</td>"
        self.parts.append('<div class=wide><table><thead><tr>' + "".join(f"<th>{html.escape(h)}</th>" for h in header)
                          + "</tr></thead><tbody>"
                          + "".join("<tr>" + "".join(map(cell, row)) + "</tr>" for row in rows)
                          + "</tbody></table></div>")

    def picture(self, name, figure, caption):
        """A figure; None is left out."""
        if figure is None:
            return
        figure.savefig(os.path.join(self.folder, name + ".svg"), bbox_inches="tight", metadata={"Date": None})
        image = io.BytesIO()
        figure.savefig(image, format="png", dpi=130, bbox_inches="tight", metadata={"Software": None})
        plt.close(figure)
        with open(os.path.join(self.folder, name + ".png"), "wb") as file:
            file.write(image.getvalue())
        data = base64.b64encode(image.getvalue()).decode()
        self.parts.append(f'<figure><img alt="{html.escape(caption)}" src="data:image/png;base64,{data}">'
                          f"<figcaption>{html.escape(caption)}</figcaption></figure>")

    def write(self):
        links = "".join(f'<a href="#{name}">{html.escape(heading)}</a>' for name, heading in self.sections)
        path = os.path.join(self.folder, "index.html")
        with open(path, "w", encoding="utf-8") as file:
            file.write(f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
                       f'<meta name="viewport" content="width=device-width, initial-scale=1">'
                       f'<link rel="icon" href="data:,"><title>{html.escape(self.title)}</title>'
                       f"<style>{STYLE}</style></head><body>\n<h1>{html.escape(self.title)}</h1>\n<nav>{links}</nav>\n"
                       + "\n".join(self.parts) + "\n</body></html>\n")
        return path
