"""Losses, schedules and the loop that yields events."""
