# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""point_design.py FILE.toml BASE KEY=JSON...: a test-only design, BASE with keys changed."""

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
from exploration.design_text import design_text  # noqa: E402

changes = {key: json.loads(value) for key, value in (w.split("=", 1) for w in sys.argv[3:])}
text = design_text(ROOT, {"base": sys.argv[2], "set": changes})
Path(sys.argv[1]).write_text(text, encoding="utf-8")
