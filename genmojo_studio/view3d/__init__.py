"""The 3D view: snapshots, cameras, renderer, widgets. Knows no panel."""
