"""Which effects a clip calls for, with evidence."""
