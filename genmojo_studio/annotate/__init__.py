"""The point-track annotator: four steps from masks to reviewed tracks."""
