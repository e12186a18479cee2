"""What the camera gave: frames, masks, depth, flow, cameras, tracks, each with validity and source."""
