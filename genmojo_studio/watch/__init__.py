"""The workspace in which a person watches, questions, compares and takes away a 4D scene."""
