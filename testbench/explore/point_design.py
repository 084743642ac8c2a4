# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""point_design.py FILE.toml BASE KEY=JSON...: a test-only design, BASE with keys changed."""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from exploring import point  # noqa: E402

changes = {key: json.loads(value) for key, value in (w.split("=", 1) for w in sys.argv[3:])}
Path(sys.argv[1]).write_text(point.design_text(sys.argv[2], changes), encoding="utf-8")
