"""The order of the dope sheet's rows."""

from __future__ import annotations

from genmojo_core.tracks.coverage import key_figures
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import mark

ORDERS = {
    "object": (mark("rows by object"), mark("Objects in their order, points by number")),
    "suspicion": (mark("worst first"), mark("The most suspicious points first")),
    "keys": (mark("fewest keys first"), mark("Points with the fewest keys first; choose it again after more keys")),
    "gap": (mark("longest gap first"), mark("Points with the longest run without a key first; choose it again to sort "
                                            "anew")),
}  # fmt: skip


def ordered(session: Session, order: str) -> list[int]:
    """Active tracks in an order of `ORDERS`; equal ones by object and point."""
    places = session.places()
    infos = sorted(session.annotation.active(), key=lambda i: (places.get(i.object, len(places)), i.number, i.id))
    tracks = [info.id for info in infos]
    if order == "suspicion":
        worst = {t: float(v.max(initial=0)) for t, v in session.suspicion.items()}
        return sorted(tracks, key=lambda t: -worst.get(t, 0.0))
    if order in ("keys", "gap"):
        counts, gaps = key_figures(session.annotation, tracks)
        figure = dict(zip(tracks, (counts if order == "keys" else -gaps).tolist(), strict=True))
        return sorted(tracks, key=figure.__getitem__)
    return tracks
