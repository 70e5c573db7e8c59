# Sphinx's settings; build.py runs it, in a folder with the documents of the repository.
import os

project = "livemesh, mesher, sac"
author = "The project's authors"
copyright = author
version = release = os.environ["SITE_VERSION"]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
html_theme = "furo"
html_title = f"Meshes that follow their input {version}"
html_copy_source = False
html_show_sourcelink = False
templates_path = []
myst_enable_extensions = ["html_image"]
myst_heading_anchors = 4
breathe_projects = {"libraries": os.environ["SITE_XML"]}
breathe_default_project = "libraries"
breathe_domain_by_extension = {"hpp": "cpp", "h": "c"}
cpp_id_attributes = ["SAC_NO_INLINE"]
default_role = "code"  # of docstrings
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_mock_imports = ["pyvista"]
html_static_path = ["site.css"]
html_css_files = ["site.css"]
pygments_style = "friendly"
highlight_language = "none"
# Parts of programs in the comments of headers, with dots for what is left out.
suppress_warnings = ["misc.highlighting_failure"]
